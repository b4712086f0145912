#pragma once

#include <optional>

#include "contact/obstacle.hpp"
#include "contact/passing.hpp"

namespace arcwall {

/// A jump of a wall's curvature that a contact passes, such as the begin of a rounded corner.
struct WallKink {
  CurvatureRateJump at{};  ///< its place and the wall's tangent there; `jump` and `half_width` mean nothing
  double sense = 1.0;      ///< −1: it is passed against the surface's direction
  double part = 0.0;       ///< of the straight line between both places
};

/// Returns whether a wall's curvature may jump: not that of a straight or smooth one.
inline bool may_have_kinks(const Obstacle& wall) { return !wall.is_smooth() && !wall.knots().empty(); }

/// Returns the first one between a contact's places at two values of λ, seen on the straight line between them. Empty:
/// there is none.
std::optional<WallKink> first_kink(const Obstacle& wall, const PlaceInStep& point, double from_lambda,
                                   double to_lambda);

/// Returns how far a place is past the kink [length], with derivatives.
LinearField past_kink(const Obstacle& wall, const WallKink& kink, const Vec2& place, double lambda);

}  // namespace arcwall
