#pragma once

#include <optional>
#include <variant>
#include <vector>

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
  Departure
      leave{};  ///< where the next step begins: at the arc's end, or near the beginning of an active set entered there
  std::optional<BranchEnd> end{};
  std::optional<CornerVisit> visit{};  ///< to be remembered
  int corners_without_progress = 0;
  std::optional<StepProgress> progress{};  ///< empty where the step's end was known before
  std::vector<Strategy> strategies{};      ///< by which a change of contacts at the arc's end was passed
};

/// An attempt at the next arc.
struct ArcAttempt {
  StepAttempt ledger{};
  std::variant<Accepted, Rejected, Retry> result{};
};

/// One arc by a step of length s: predict and correct, land on the first change of contacts, then on the first event
/// before it; leave the change. Where the step's end is known already, the first point of an active set that was just
/// entered among such, the arc passes the same checks from there on.
ArcAttempt attempt_arc(TraceTools& tools, const TracerState& state, double s, Effort effort = Effort::usual);

}  // namespace arcwall
