#include "answers/find_event.hpp"

#include <fmt/format.h>

#include <utility>

#include "answers/jumps.hpp"
#include "model/event_names.hpp"

namespace arcwall {

void EventHunt::explore() {
  ExploreOptions options = model_.explore();
  options.jump = [&model = model_](const Event& lost, const PathPoint& behind) -> JumpEnd {
    Fall fall = fall_beyond(model, lost, behind);
    return {.state = std::move(fall.state), .why_none = fall.jump->why};
  };
  explorer_ = std::make_unique<Explorer>(model_.system(), start_, model_.options(), model_.watched(), options);
}

bool EventHunt::advance() {
  if (found_ || !problem_.empty()) return false;
  if (!explorer_) {
    auto start = model_.start(problem_);
    if (!start) return false;
    start_ = std::move(*start);
    explore();
  }
  const auto step = explorer_->next();
  if (!step) {
    problem_ = fmt::format("the path has {} of kind {}, not {}", met_ == 0 ? "none" : "only " + std::to_string(met_),
                           to_text(kind_), number_);
    return false;
  }
  for (const Event& event : step->arc.events)
    if (event.kind == kind_ && ++met_ == number_) {
      found_ = FoundEvent{.arc = step->arc, .event = event};
      return false;
    }
  if (auto why = model_.adrift(step->arc.to.state))
    explorer_->stop({.reason = EndReason::rigid_body_motion, .detail = std::move(*why)});
  return true;
}

std::optional<FoundEvent> find_event(const Model& model, EventKind kind, int number,
                                     const std::function<bool()>& stopped, std::string& problem) {
  EventHunt hunt(model, kind, number);
  while (hunt.advance())
    if (stopped && stopped()) {
      problem = "stopped before the event was found";
      return std::nullopt;
    }
  problem = hunt.problem();
  return hunt.found();
}

}  // namespace arcwall
