#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// λ₀ of the path metric for a path that begins at `start`: the change of λ that would move the structure by 1 if it
/// stayed linear, but not much more than the one that would change the stiffness of its softest modes by as much as it
/// is (docs/theory.md, section 3). Empty where λ does not move the structure, as a load that presses on a contact.
std::optional<double> natural_lambda_scale(TraceTools& tools, const State& start);

}  // namespace arcwall
