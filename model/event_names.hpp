#pragma once

#include <optional>
#include <string_view>

#include "continuation/path_point.hpp"

/// Names of events and ends in the output files.
namespace arcwall {

/// Returns `contact-closes`, `limit-point`, …
std::string_view to_text(EventKind kind);

/// Returns `open`, `closed`, `stick`, `slip+` or `slip-`.
std::string_view to_text(ContactMode mode);

/// Returns `stop`, `min_step`, …
std::string_view to_text(EndReason reason);

/// Returns `stable`, `unstable` or `undecided`.
std::string_view to_text(Stability stability);

/// Returns `pitchfork`, `transcritical`, `one-sided` or `multiple`.
std::string_view to_text(BranchType type);

/// Returns `maximum` or `minimum`.
std::string_view to_text(Extremum extremum);

/// Returns the kind of that name; empty if there is none.
std::optional<EventKind> event_kind(std::string_view text);

/// Returns the reason of that name; empty if there is none.
std::optional<EndReason> end_reason(std::string_view text);

/// Returns the explanation of a reason, a sentence without a full stop.
std::string_view explanation(EndReason reason);

/// Returns what a user can try after an early end; empty for reasons that are no early end.
std::string_view what_to_try(EndReason reason);

}  // namespace arcwall
