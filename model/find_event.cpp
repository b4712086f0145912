#include "model/find_event.hpp"

#include <fmt/format.h>

#include <utility>

#include "continuation/explorer.hpp"
#include "model/event_names.hpp"

namespace arcwall {

std::optional<FoundEvent> find_event(const Model& model, EventKind kind, int number,
                                     const std::function<bool()>& stopped, std::string& problem) {
  auto start = model.start(problem);
  if (!start) return std::nullopt;
  Explorer explorer(model.system(), std::move(*start), model.options(), model.watched(), model.explore());
  int found = 0;
  while (const auto step = explorer.next()) {
    for (const Event& event : step->arc.events)
      if (event.kind == kind && ++found == number) return FoundEvent{.arc = step->arc, .event = event};
    if (auto why = model.adrift(step->arc.to.state))
      explorer.stop({.reason = EndReason::adrift, .detail = std::move(*why)});
    if (stopped && stopped()) {
      problem = "stopped before the event was found";
      return std::nullopt;
    }
  }
  problem = fmt::format("the path has {} of kind {}, not {}", found == 0 ? "none" : "only " + std::to_string(found),
                        to_text(kind), number);
  return std::nullopt;
}

}  // namespace arcwall
