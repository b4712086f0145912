#pragma once

#include <optional>
#include <vector>

#include "continuation/path_point.hpp"
#include "continuation/step/path_constraint.hpp"

namespace arcwall {

/// Outcomes of an attempted step.
enum class StepOutcome {
  accepted,
  too_many_iterations,
  diverged,
  complex_roots,
  singular,
  not_finite,
  obstructed,         ///< a closed contact has left its wall
  behind_end,         ///< the structure entered a wall through its open end
  left_path,          ///< the corrector converged too far from the predictor
  tangent_angle,      ///< the tangent angle exceeds StepOptions::max_turn
  event_not_located,  ///< the active-set change was not located
  penetration,        ///< the structure penetrates a wall between the contacts
  blocked,            ///< a wall would enter a place that supports hold
  contact_inserted,   ///< the same; contacts were added there and the step is repeated
  events_unclear,     ///< an event inside the step was not located
  ended,              ///< the branch ends here
};

/// What an attempted step used beyond the ordinary step. The text of the step log is that of to_text in
/// model/step_ledger.
enum class Strategy {
  tangent_guess,      ///< the guess along the curved path failed; the corrector started on the tangent
  beside_singular,    ///< the step ended on a singular point; it was repeated with 0.93 of its length
  longer_step,        ///< no step above StepOptions::min succeeded; a longer one did without the divergence test
  near_guard,         ///< no step succeeded; a guard that is almost zero was passed
  other_zone,         ///< the ordinary form of the next contact zone had no equilibrium
  shorter_zone,       ///< the new zone was entered with a part of its first length
  more_iterations,    ///< the first point of the next active set took the larger number of iterations
  unsure_zone,        ///< the new zone is not sure to hold, and none that is was found
  nearly_degenerate,  ///< contacts changed that are degenerate within the mesh error only
};

/// Stores a row of the step log.
struct StepAttempt {
  double arc = 0.0;     ///< of the step's start [path metric]
  double radius = 0.0;  ///< attempted length [path metric]
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  double residual = 0.0;                   ///< relative; 0 where the corrector did not converge
  std::optional<ConstraintRoots> roots{};  ///< of the last correction
  std::optional<double> turn{};            ///< of the tangent over the step [rad]
  std::vector<Strategy> strategies{};      ///< beyond the ordinary step
  const Arc* accepted = nullptr;           ///< accepted arc, valid during the call; null if rejected
};

}  // namespace arcwall
