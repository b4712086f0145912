#pragma once

#include <optional>

#include "continuation/corners/choice.hpp"
#include "continuation/tracer_state.hpp"

namespace arcwall {

/// The first arc of a branch, of length zero, with the `start` event, and what is known behind it; or why there is
/// none.
struct BranchBegun {
  Arc arc{};
  Departure from{};
  double step_length = 0.0;  ///< of the first step [path metric]
  std::optional<CornerVisit> visit{};
  std::optional<BranchEnd> end{};
};

/// Begins the branch of `state`, of which no point is known yet.
BranchBegun begin_branch(TraceTools& tools, const TracerState& state);

}  // namespace arcwall
