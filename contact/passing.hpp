#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/obstacle.hpp"

namespace arcwall {

/// A place of the body before and behind a step.
struct PlaceInStep {
  Vec2 from, to;
};

/// Whether the curvatures of a surface at two places beside each other tell that it jumps between them [1/length].
inline bool curvature_jumps(double here, double there) {
  constexpr double smooth = 1e-2;  // part of the greater one, where it does not
  return std::abs(there - here) > smooth * std::max(std::abs(here), std::abs(there));
}

/// Whether a point of the body that goes straight, as the obstacle sees it, enters the obstacle between two values of
/// λ: it leaves it again, or is deeper inside in the end than what touches may be [length]. The obstacle has other
/// sides.
bool point_passes_through(const Obstacle& obstacle, const PlaceInStep& point, double from_lambda, double to_lambda,
                          double touching);

/// Whether a straight line between two points of the body, which go straight as the obstacle sees them, passes over its
/// core between two values of λ, or comes as near to it as what touches may be off by [length]. An obstacle without a
/// core is never passed over.
bool line_passes_core(const Obstacle& obstacle, const PlaceInStep& first, const PlaceInStep& last, double from_lambda,
                      double to_lambda, double touching);

/// By which angle the way along a line, from 0 to 1, goes round a place [rad]. The line turns by less than a right
/// angle, and is known to what touches may be off by [length].
double turn_about(const Vec2& centre, const std::function<Vec2(double)>& line, double touching);

}  // namespace arcwall
