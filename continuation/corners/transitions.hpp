#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// The start of a step on the layout of a transition from it. Empty if no equilibrium of that layout passes through the
/// start.
std::optional<Departure> departure_on(TraceTools& tools, const StepOrigin& origin, const Transition& transition);

}  // namespace arcwall
