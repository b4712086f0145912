#pragma once

#include <optional>
#include <variant>

#include "continuation/corners/choice.hpp"
#include "continuation/step/step.hpp"
#include "continuation/tracer_state.hpp"

namespace arcwall {

/// What the length of the next step follows from.
struct StepProgress {
  int iterations = 0;
  double turn = 0.0;   ///< of the tangent [rad]
  double taken = 0.0;  ///< length [path metric]
};

/// An arc that is taken, and where it leads.
struct Accepted {
  Arc arc{};
  Departure leave{};             ///< where the next step begins: at the arc's end, or at the pending point
  std::optional<Arc> pending{};  ///< the first point of the piece ahead, where it lies beyond the arc's end
  std::optional<BranchEnd> end{};
  std::optional<CornerVisit> visit{};  ///< to be remembered
  int corners_without_progress = 0;
  StepProgress progress{};
};

/// An attempt at the next arc.
struct ArcAttempt {
  StepAttempt ledger{};
  std::variant<Accepted, Rejected, Retry> result{};
};

/// One arc by a step of length s: predict and correct, land on the first change of contacts, then on the first event
/// before it; leave the change.
ArcAttempt attempt_arc(TraceTools& tools, const TracerState& state, double s);

}  // namespace arcwall
