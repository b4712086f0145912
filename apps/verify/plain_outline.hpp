#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"
#include "model/deck/deck.hpp"

namespace arcwall::verify {

/// An outline as its deck describes it, at rest, by formulas of its own: what tracing uses has no part in it.
class PlainOutline {
 public:
  /// Of a wall that has one.
  explicit PlainOutline(const deck::Wall& wall);

  /// What is nearest to a point.
  struct Nearest {
    double distance = 0.0;   ///< positive where the body may be [length]
    double angle = 0.0;      ///< of the outline, the body to its left [rad]
    double curvature = 0.0;  ///< of the outline, > 0 to the left [1/length]
    bool beyond = false;     ///< beyond an end
  };
  Nearest nearest(const Vec2& point) const;

  /// A place far inside the wall, behind its outline; empty of a straight line and where the body is inside.
  std::optional<Vec2> innermost() const;

  /// Of what stands out of it, roughly; ∞ of a straight line [length].
  double width() const { return width_; }

 private:
  // A line, or an arc about a centre between two of its points, in the order in which the outline has them. Of radius 0
  // it is a sharp corner.
  struct Part {
    Vec2 from, to;
    bool is_arc = false;
    Vec2 centre = Vec2::Zero();
    double radius = 0.0;  // > 0 where the body is outside of it, < 0 where it is inside
  };
  Nearest nearest_of_ellipse(const deck::EllipseOutline& ellipse, const Vec2& point) const;
  Nearest nearest_of_parts(const Vec2& point) const;
  Nearest nearest_of_curve(const Vec2& point) const;
  void make_parts(const std::vector<Vec2>& corners, const std::vector<double>& radii, bool is_closed);
  void make_curve(std::vector<Vec2> points, bool is_closed);

  // A place of the curve by its parameter, with the first two derivatives.
  struct OnCurve {
    Vec2 p, first, second;
  };
  OnCurve on_curve(double a) const;

  deck::Outline outline_;
  bool is_closed_ = true, stays_outside_ = false;  // the latter of closed ones
  double width_ = infinity;
  std::vector<Part> parts_{};
  std::vector<double> at_{};             // parameters of the curve's points
  std::vector<Vec2> points_{}, bend_{};  // with the second derivatives there
};

}  // namespace arcwall::verify
