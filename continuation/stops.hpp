#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuation/trace_options.hpp"

namespace arcwall {

/// The end of a branch at the first point behind a change of contacts, if so many are closed there; if none is wanted,
/// where the last one is gone.
std::optional<BranchEnd> stop_at_contacts(const TraceOptions& options, const ActiveSet& before,
                                          const ActiveSet& active_set);

/// The end of a branch that passes a bound on the way from one state to another.
std::optional<BranchEnd> stop_at_bounds(const TraceOptions& options, const State& from, const State& to);

/// The end of a branch at a point with such events.
std::optional<BranchEnd> stop_at_events(const TraceOptions& options, const std::vector<Event>& events);

/// The end of a branch at a wall that has come to a place that supports hold. `place`: `floor at beam:1`.
BranchEnd blocked_end(const std::string& place);

/// Returns the detail of an end behind which another branch continues the path: switched_branch or jumped.
std::string detail_of_partner(EndReason reason, int branch);

}  // namespace arcwall
