#pragma once

#include <string>

#include "continuation/step/landed_guard.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// The end of a step.
struct StepEnd {
  PathPoint point{};
  double turn = 0.0;  ///< of the tangent over the step that was tried [rad]
  std::optional<Landing> landing{};
  bool over_kink = false;  ///< the step leads over a kink of the path alone
};

/// What landing on the first guard made of a step's end.
struct LandedStep {
  std::optional<StepEnd> end{};  ///< empty: no point of the path was found where contacts change
  CorrectorStatus failure = CorrectorStatus::converged;  ///< of the correction that found none
  std::string where{};                                   ///< what that guard watches, for messages
};

/// Ends a step where a guard first vanishes inside it; a step whose guards hold stays as it is.
LandedStep land_on_first_guard(TraceTools& tools, const StepOrigin& origin, StepEnd end);

}  // namespace arcwall
