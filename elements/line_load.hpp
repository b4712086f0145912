#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/types.hpp"
#include "elements/driven.hpp"

namespace arcwall {

/// Axes of a distributed load: x and z, or along the stress-free axis and normal to it (positive to the left). Both are
/// dead loads.
enum class LoadFrame { global, member };

/// Length that a distributed load is given by: of the stress-free axis, or of its projection on x.
enum class LoadMeasure { axis, plan };

/// A dead load along a member, linear between its ends: all that elements and contact know of one.
struct LineLoad {
  Vec2 first = Vec2::Zero();  ///< at the beginning of the member [force/length]
  Vec2 slope = Vec2::Zero();  ///< by arc length of the stress-free axis [force/length²]
  LoadFrame frame = LoadFrame::global;
  LoadMeasure measure = LoadMeasure::axis;

  bool is_uniform() const { return slope.isZero(); }
  /// Whether it is a constant vector along a curved axis.
  bool is_straight() const { return frame == LoadFrame::global && measure == LoadMeasure::axis; }

  /// The load by length of the axis at an arc length S, where the stress-free axis has an angle [force/length].
  Vec2 at(double S, double angle) const { return plan(angle) * turned(first + S * slope, angle); }

  /// Its derivatives there, by S at constant angle and by the angle.
  Vec2 by_S(double angle) const { return plan(angle) * turned(slope, angle); }
  Vec2 by_angle(double S, double angle) const {
    const Vec2 q = turned(first + S * slope, angle);
    Vec2 rate = frame == LoadFrame::member ? Vec2(plan(angle) * perp(q)) : Vec2(Vec2::Zero());
    if (measure == LoadMeasure::plan) rate -= std::copysign(1.0, std::cos(angle)) * std::sin(angle) * q;
    return rate;
  }

  /// Changes its sign where the load has a kink along the axis, at an angle of this.
  double sign(double angle) const { return measure == LoadMeasure::plan ? std::cos(angle) : 1.0; }

  /// The greater one of those at its ends [force/length].
  double greatest(double length) const { return std::max(first.norm(), (first + length * slope).norm()); }

  bool operator==(const LineLoad&) const = default;

 private:
  double plan(double angle) const { return measure == LoadMeasure::plan ? std::abs(std::cos(angle)) : 1.0; }
  Vec2 turned(const Vec2& given, double angle) const {
    if (frame == LoadFrame::global) return given;
    const Vec2 t(std::cos(angle), std::sin(angle));
    return given.x() * t + given.y() * perp(t);
  }
};

/// A dead load and what λ does to it.
struct DrivenLineLoad {
  LineLoad load{};
  Driven factor{};

  /// What λ = 1 drives along a member of a length, at most [force].
  double greatest_force(double length) const { return std::abs(factor.proportional) * load.greatest(length) * length; }

  bool operator==(const DrivenLineLoad&) const = default;
};

/// The pieces of a stretch on each of which a load is smooth, by fractions of it.
class SmoothPieces {
 public:
  SmoothPieces() = default;  ///< one
  /// `angle`: of the axis at a fraction, which a load by plan has at most one kink in each third for.
  SmoothPieces(const LineLoad& load, const std::function<double(double)>& angle);

  std::size_t count() const { return count_; }
  double begin(std::size_t piece) const { return ends_[piece]; }
  double length(std::size_t piece) const { return ends_[piece + 1] - ends_[piece]; }

 private:
  std::array<double, 5> ends_{0.0, 1.0};
  std::size_t count_ = 1;
};

/// Adds a load to others; loads that differ in size alone become one.
void combine(const DrivenLineLoad& load, std::vector<DrivenLineLoad>& to);

}  // namespace arcwall
