#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "elements/spring_law.hpp"

namespace arcwall {

/// The gap between places and a wall that λ may move.
class WallGap {
 public:
  virtual ~WallGap() = default;

  struct Slope {
    double value = infinity;    ///< [length]
    Vec2 slope = Vec2::Zero();  ///< by the place
  };
  /// Gap and slope; infinite and 0 where the wall has no surface.
  virtual Slope slope(const Vec2& place, double lambda) const = 0;

  struct Response {
    double value = 0.0, rate = 0.0;  ///< gap, and its rate by λ
    Vec2 slope = Vec2::Zero(), slope_rate = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  };
  /// With second derivatives; only where the gap is finite.
  virtual Response at(const Vec2& place, double lambda) const = 0;

  /// Likewise the arc length along the wall, with the structure to its left, of what a place faces [length].
  virtual Response along(const Vec2& place, double lambda) const = 0;
};

/// The pressure of a compliant wall by the penetration p ≥ 0, by length of a member's axis [force/length].
class PressureLaw {
 public:
  /// w = k p, and with a depth c: w = k c (exp(p/c) − 1). `stiffness` k > 0 [force/length²], c > 0 [length].
  explicit PressureLaw(double stiffness, std::optional<double> depth = {}) : stiffness_(stiffness), depth_(depth) {}

  /// From a table whose first point is (0, 0); `points`: its other penetrations.
  PressureLaw(std::shared_ptr<const SpringLaw> table, std::vector<double> points)
      : table_(std::move(table)), points_(std::move(points)) {}

  struct Response {
    double energy = 0.0, pressure = 0.0, stiffness = 0.0;  ///< W, W′ and W″
  };
  Response at(double penetration) const;

  /// Penetrations > 0 at which W″ or its slope jumps, ascending.
  const std::vector<double>& kinks() const { return points_; }

 private:
  double stiffness_ = 0.0;
  std::optional<double> depth_{};
  std::shared_ptr<const SpringLaw> table_{};
  std::vector<double> points_{};
};

/// A compliant wall in the way of a member.
struct CompliantWall {
  enum class Touched {
    axis,
    face,     ///< of the section, on the side that looks at the wall: of one that stands across it, both
    outside,  ///< half the height all round the axis
  };
  std::shared_ptr<const WallGap> gap{}, gap_of_ramp{};  ///< on the path, and while what is constant grows
  std::shared_ptr<const PressureLaw> law{};
  Touched touched = Touched::axis;
  double kept_off = 0.0;   ///< the half height that the gap of an outside counts already [length]
  bool is_over = false;    ///< the members, of a wall that faces touch
  bool rubs_axis = false;  ///< friction acts on the axis, whatever is touched
};

}  // namespace arcwall
