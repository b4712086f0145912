#pragma once

#include <string>

#include "model/record.hpp"

namespace arcwall {

/// events.txt: the title, the events as a table for people, and how each branch ended.
std::string events_text(const Record& record);

/// What there is to say of an event beside its kind: which contacts change, the type of a branch point, why a branch
/// ends.
std::string event_detail(const RecordEvent& event);

/// `0 → 1`: unstable directions before and after an event, or the one number if they are the same; `?` if unknown.
std::string unstable_change(const RecordEvent& event);

/// `%.{digits}g` without −0.
std::string shown_number(double value, int digits);

/// `w = 1.2 (stop)`: what is known of an end, and its reason.
std::string how_it_ended(const BranchEnd& end);

}  // namespace arcwall
