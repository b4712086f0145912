#pragma once

#include "continuation/events/singular_place.hpp"
#include "continuation/events/singular_search.hpp"

namespace arcwall {

/// The count changes between the step's origin and its end, and λ does not turn; or an eigenvalue may have come to zero
/// and gone back.
SingularSearch find_branch_points(TraceTools& tools, const StepOrigin& origin, const PathPoint& to);

/// A place that was located, as a point of the path, with the interpolated tangent: its own may be any where K is
/// singular.
PathPoint point_at(TraceTools& tools, const StepOrigin& origin, const SingularPlace& place);

/// Steps below this length show no more when they are made shorter [path metric].
inline constexpr double shortest_telling_step = 1e-4;

}  // namespace arcwall
