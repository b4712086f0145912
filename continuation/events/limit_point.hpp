#pragma once

#include "continuation/events/singular_search.hpp"

namespace arcwall {

/// λ turns between the step's origin and its end: the limit point, with a branch point where one lies at the same
/// place; or the branch points that come before it.
SingularSearch find_limit_point(TraceTools& tools, const StepOrigin& origin, const PathPoint& to);

/// λ′ may touch zero, or change its sign twice, and look as if it had not: then the cubic through λ at the ends comes
/// near, and the first place is looked for.
SingularSearch find_touching_limit(TraceTools& tools, const StepOrigin& origin, const Segment& segment);

/// Whether λ may turn twice inside a segment, or nearly, and look as if it had not: then the cubic through its ends
/// does. `part`: of the lesser rate at the ends, below which the least rate inside must lie; a negative one is taken as
/// it is.
bool hides_two_zeros(const std::vector<EventDetector>& detectors, const Segment& segment, double part);

}  // namespace arcwall
