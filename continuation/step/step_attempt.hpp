#pragma once

#include <optional>

#include "continuation/path_point.hpp"
#include "continuation/step/path_constraint.hpp"

namespace arcwall {

/// What became of an attempted step.
enum class StepOutcome {
  accepted,
  too_many_iterations,
  diverged,
  complex_roots,
  singular,
  not_finite,
  obstructed,         ///< a closed contact has left its wall
  behind_end,         ///< the body has come into a wall from beyond the wall's end, where that has no face
  left_path,          ///< the corrector ended far off the predictor
  tangent_angle,      ///< the tangent turned more than is trusted
  event_not_located,  ///< no point of the path where contacts change
  penetration,        ///< the body enters a wall between the contacts
  contact_inserted,   ///< the same, and contacts there are watched from now on: the step is tried again
  events_unclear,     ///< an event lies inside that could not be located
  ended,              ///< the branch ends here
};

/// A row of the ledger of steps.
struct StepAttempt {
  double arc = 0.0;     ///< of the step's start [path metric]
  double radius = 0.0;  ///< length that was tried [path metric]
  StepOutcome outcome = StepOutcome::accepted;
  int iterations = 0;
  double residual = 0.0;                   ///< relative; 0 where the corrector did not converge
  std::optional<ConstraintRoots> roots{};  ///< of the last correction
  std::optional<double> turn{};            ///< of the tangent over the step [rad]
  const Arc* accepted = nullptr;           ///< with its events; for the time of the call
};

}  // namespace arcwall
