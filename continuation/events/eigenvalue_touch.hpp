#pragma once

#include "continuation/segment.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// Whether, as the eigenpairs at its ends show it, an eigenvalue may have come to zero inside a segment and gone back,
/// or two have passed zero in opposite senses. The segment begins at the step's origin.
bool may_touch_zero(TraceTools& tools, const StepOrigin& origin, const Segment& segment);

/// Of the modes nearest zero at one point their eigenvalues at another, NaN where those are not nearest there.
Vector eigenvalues_of_modes(const PathPoint& modes_at, const PathPoint& values_at, const Metric& metric);

}  // namespace arcwall
