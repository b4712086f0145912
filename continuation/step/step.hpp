#pragma once

#include <string>
#include <variant>

#include "continuation/step/landing.hpp"

namespace arcwall {

/// A step that leads nowhere: a shorter one is tried.
struct Rejected {
  StepOutcome outcome = StepOutcome::too_many_iterations;
  CorrectorStatus failure = CorrectorStatus::converged;  ///< of the correction that failed, if one did
  std::string where{};                                   ///< the wall that is entered, and where, if that is known
};

/// The step's start in the unknowns of an active set whose guards see what the step's end violates: the step is tried
/// again from there.
struct Retry {
  Departure finer{};
};

/// A step that was tried: what the ledger says of it, and what became of it.
struct StepTried {
  StepAttempt attempt{};
  std::variant<StepEnd, Rejected, Retry> result{};
};

/// A step of length s along the path, to the first change of contacts inside it.
StepTried try_step(TraceTools& tools, const StepOrigin& origin, double s);

/// The same, of a length at which the path is not singular: a step that ends on a singular point shows nothing of it,
/// and its tangent there may be any.
StepTried try_step_clear_of_singular(TraceTools& tools, const StepOrigin& origin, double s);

}  // namespace arcwall
