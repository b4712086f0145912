#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// A point of a plane curve that is measured by its arc length.
struct AxisPoint {
  Vec2 position{};
  double angle = 0.0;           ///< of the tangent, continuous along the curve [rad]
  double curvature = 0.0;       ///< d angle / d arc length [1/length]
  double curvature_rate = 0.0;  ///< d curvature / d arc length [1/length²]
};

/// 90° anticlockwise from the tangent at that angle.
inline Vec2 axis_normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }

/// The stress-free axis of a member, without imperfection.
class Axis {
 public:
  virtual ~Axis() = default;
  virtual double length() const = 0;
  virtual bool is_straight() const { return false; }

  /// The curvature of a curve that has the same all along [1/length]; empty of others.
  virtual std::optional<double> constant_curvature() const { return std::nullopt; }

  /// At arc length s from the start, 0 ≤ s ≤ length().
  virtual AxisPoint at(double s) const = 0;

  /// at(to).position − at(from).position, to the digits of to − from where the curve's formula allows it.
  virtual Vec2 chord(double from, double to) const { return at(to).position - at(from).position; }
};

std::unique_ptr<Axis> straight_axis(const Vec2& from, const Vec2& to);

/// Circular arc through `via`, which must not lie on the line of the ends.
std::unique_ptr<Axis> arc_axis(const Vec2& from, const Vec2& via, const Vec2& to);

/// The full circle from a point, once round through `via` and then `later`, which are two others.
std::unique_ptr<Axis> circle_axis(const Vec2& from, const Vec2& via, const Vec2& later);

/// chord + rise · sin(waves π ξ), ξ the fraction along the chord; positive 90° anticlockwise from the chord.
std::unique_ptr<Axis> sine_axis(const Vec2& from, const Vec2& to, double rise, int waves);

/// Interpolating cubic spline over the cumulative chord length of the points (at least two, none twice in a row).
std::unique_ptr<Axis> spline_axis(const std::vector<Vec2>& points);

/// One sine wave of a stress-free deviation normal to the axis.
struct SineDeviation {
  double amplitude = 0.0;  ///< positive 90° anticlockwise from the direction of travel [length]
  int waves = 1;           ///< half waves over the axis' arc length
};

/// A point of a curve that deviates from an axis, and how it moves with the arc length s of that axis.
struct DeviatedPoint {
  Vec2 position{};
  Vec2 deviation{};      ///< from the axis [length]
  double angle = 0.0;    ///< of the tangent, continuous [rad]
  double speed = 1.0;    ///< arc length of the curve per s
  double turning = 0.0;  ///< d angle / ds [1/length]
};

/// A part of a deviated curve.
struct DividedPart {
  enum class Inside { wanted, left_out };  ///< the points between the ends

  static constexpr int points = 4;
  double length = 0.0;                     ///< arc length of the curve
  Vec2 chord = Vec2::Zero();               ///< from the first end to the second [length]
  std::array<DeviatedPoint, points> at{};  ///< at 0, ⅓, ⅔ and 1 of that length
};

/// An axis with its imperfections: the stress-free shape of the member.
class ImperfectAxis {
 public:
  /// `axis` must outlive this.
  ImperfectAxis(const Axis& axis, std::vector<SineDeviation> deviations);

  /// Of the axis itself.
  bool is_straight() const { return axis_.is_straight(); }
  double axis_length() const { return axis_.length(); }
  const std::vector<SineDeviation>& deviations() const { return deviations_; }

  /// The deviated curve at arc length s of the axis.
  DeviatedPoint along(double s) const;

  /// Its position and angle alone: the curvatures are not filled in.
  AxisPoint at(double s) const;

  /// Arc length of the deviated curve between two such points.
  double length(double from, double to) const;

  /// The deviated curve between two such points. Points that are left out are zero.
  DividedPart divided(double from, double to, DividedPart::Inside inside = DividedPart::Inside::wanted) const;

 private:
  struct Deviation {
    double value, slope, second;
  };
  Deviation deviation(double s) const;
  double speed(double s) const;
  double phase(double from, double to) const;
  double coordinate_at(double from, double length, double guess) const;

  const Axis& axis_;
  std::vector<SineDeviation> deviations_;
  double wave_number_;  // greatest of the deviations
};

/// Points of a member's curve at the nodes of its mesh, at equal spacing of the axis' arc length; the ends are where
/// joints were put. Those of a straight line are made when they are asked for: a mesh may have very many.
class AxisPoints {
 public:
  AxisPoints() = default;

  /// Of `axis` with these imperfections.
  AxisPoints(std::shared_ptr<const Axis> axis, const std::vector<SineDeviation>& deviations, int elements,
             const Vec2& first, const Vec2& last);

  AxisPoint operator[](std::size_t k) const;
  AxisPoint front() const { return (*this)[0]; }
  AxisPoint back() const { return (*this)[elements_]; }

 private:
  double arc(std::size_t k) const { return axis_->length() * double(k) / double(elements_); }

  std::shared_ptr<const Axis> axis_;
  std::size_t elements_ = 0;
  Vec2 first_ = Vec2::Zero(), last_ = Vec2::Zero();
  std::vector<AxisPoint> points_;  // of a curve
};

/// Diagonal of the smallest upright rectangle round points [length].
double box_diagonal(const std::vector<Vec2>& points);

}  // namespace arcwall
