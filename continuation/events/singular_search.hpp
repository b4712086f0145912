#pragma once

#include <vector>

#include "continuation/events/singular_point.hpp"
#include "continuation/segment.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// The first singular points of a step, in their order; none of most steps.
struct SingularSearch {
  std::vector<SingularPoint> points{};
  bool clear = true;                                     ///< false: shorter steps will show more
  CorrectorStatus failure = CorrectorStatus::converged;  ///< of the correction at which that showed
};

/// Looks for singular points between the step's origin and its end.
SingularSearch find_singular(TraceTools& tools, const StepOrigin& origin, const PathPoint& to);

}  // namespace arcwall
