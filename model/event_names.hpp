#pragma once

#include <optional>
#include <string_view>

#include "continuation/path_point.hpp"

/// The words that the outputs have for the events and ends of a path.
namespace arcwall {

/// `contact-closes`, `limit-point`, …
std::string_view to_text(EventKind kind);

/// `stop`, `min_step`, …
std::string_view to_text(EndReason reason);

/// `stable`, `unstable` or `undecided`.
std::string_view to_text(Stability stability);

/// `pitchfork`, `transcritical`, `one-sided` or `multiple`.
std::string_view to_text(BranchType type);

/// `maximum` or `minimum`.
std::string_view to_text(Extremum extremum);

/// The kind of that name, or nothing.
std::optional<EventKind> event_kind(std::string_view text);

/// The reason of that name, or nothing.
std::optional<EndReason> end_reason(std::string_view text);

/// Whether contacts change at such an event: contact-closes, contact-splits, …
bool changes_contact(EventKind kind);

/// What a reason means, in a sentence without a full stop.
std::string_view explanation(EndReason reason);

/// What a user can try where a branch ended early for a reason; empty where it did not end early.
std::string_view what_to_try(EndReason reason);

}  // namespace arcwall
