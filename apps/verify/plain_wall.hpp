#pragma once

#include <vector>

#include "core/types.hpp"
#include "model/deck/deck.hpp"

namespace arcwall::verify {

/// A wall as its deck describes it, evaluated by formulas of its own: what tracing uses has no part in it.
class PlainWall {
 public:
  /// `wall` must outlive this.
  explicit PlainWall(const deck::Wall& wall);

  const deck::Wall& deck() const { return wall_; }

  /// +1 below the structure, −1 above it.
  double side() const { return wall_.side == Side::below ? 1.0 : -1.0; }

  bool covers(double x) const;

  /// Height of the surface and its slope; where covers(x).
  double height(double x) const;
  double slope(double x) const;
  double slope_angle(double x) const;
  double curvature(double x) const;

  /// Vertical distance from the surface times the cosine of its slope, positive outside.
  double gap(const Vec2& point) const;

  /// Of what stands out of the wall, as far as its outline tells: diameters; ∞ of straight ones [length].
  double width() const;

  bool concerns(const std::string& member) const;

 private:
  struct Surface {
    double height, slope, second;
  };
  Surface at(double x) const;

  const deck::Wall& wall_;
  std::vector<double> second_{};  // derivatives of a spline at its knots
};

}  // namespace arcwall::verify
