#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// The start of a step in the unknowns of an active set whose guards see what is below `margin` at `violated`, where
/// the step led. Empty if no such active set passes through the start.
std::optional<Departure> with_new_contact(TraceTools& tools, const StepOrigin& origin, const State& violated,
                                          double margin);

/// The same on a mesh that suits a guard which was landed on at the end of the step. Empty if the start has it, or no
/// such active set passes through it.
std::optional<Departure> with_mesh_for_landing(TraceTools& tools, const StepOrigin& origin, const State& end,
                                               Index guard);

}  // namespace arcwall
