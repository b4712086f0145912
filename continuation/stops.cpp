#include "continuation/stops.hpp"

#include <algorithm>
#include <string>

#include "core/text.hpp"

namespace arcwall {

std::optional<BranchEnd> stop_at_contacts(const TraceOptions& options, const ActiveSet& before,
                                          const ActiveSet& active_set) {
  if (!options.stop_contacts) return std::nullopt;
  const Index closed = active_set.closed_count(), wanted = *options.stop_contacts;
  const bool met = wanted > 0 ? closed >= wanted : closed == 0 && before.closed_count() > 0;
  if (!met) return std::nullopt;
  return BranchEnd{.reason = EndReason::stop, .detail = "contacts = " + std::to_string(closed)};
}

std::optional<BranchEnd> stop_at_bounds(const TraceOptions& options, const State& from, const State& to) {
  const auto& values = options.target_values;
  const auto found = std::find_if(values.begin(), values.end(), [&](const TargetValue& bound) {
    const double before = bound.quantity->value(from) - bound.value, after = bound.quantity->value(to) - bound.value;
    return bound.stops && before != 0.0 && before * after <= 0.0;
  });
  if (found == values.end()) return std::nullopt;
  return BranchEnd{.reason = EndReason::stop, .detail = found->label};
}

std::optional<BranchEnd> stop_at_events(const TraceOptions& options, const std::vector<Event>& events) {
  std::optional<BranchEnd> met;
  for (const StopEvent& stop : options.stop_events)
    if (std::any_of(events.begin(), events.end(), [&](const Event& event) { return event.kind == stop.kind; }))
      met = {.reason = EndReason::stop, .detail = stop.label};
  return met;
}

BranchEnd blocked_end(const std::string& place) {
  return {.reason = EndReason::jammed,
          .detail = with_place("the wall has reached a supported place, and neither can move", place)};
}

std::string detail_of_partner(EndReason reason, int branch) {
  const std::string after = reason == EndReason::jumped ? "continues after a jump" : "continues";
  return after + " as branch " + std::to_string(branch);
}

}  // namespace arcwall
