#pragma once

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// Makes an accepted point the start of the next step where the equations have a history (PathHistory): the point gets
/// the internal variables that it has now, and the tangent of what slips from there on. `forward`: its sense, roughly;
/// `length`: of the step that ends. Returns whether the tangent has changed.
bool commit(TraceTools& tools, const Metric& metric, const Direction& forward, double length, PathPoint& at);

}  // namespace arcwall
