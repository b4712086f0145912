#pragma once

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// λ₀ of the path metric for a path that begins at `start`: the change of λ that would move the structure by 1 if it
/// stayed linear, but not much more than the one that would change the stiffness of its softest modes by as much as it
/// is (docs/theory.md, section 3). The first step where neither can be told.
double natural_lambda_scale(TraceTools& tools, const State& start);

}  // namespace arcwall
