#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// Makes an accepted point the start of the next step where the equations have a history (PathHistory): the point gets
/// the internal variables that it has now, and the tangent of what slips from there on. `forward`: its sense, roughly;
/// `length`: of the step that ends. Returns whether the tangent has changed; empty if no tangent was found that what
/// slips agrees with.
std::optional<bool> commit(TraceTools& tools, const Metric& metric, const Direction& forward, double length,
                           PathPoint& at);

/// Returns the end of a branch at a point that could not be committed.
BranchEnd end_without_tangent();

}  // namespace arcwall
