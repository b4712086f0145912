#pragma once

#include <string>
#include <vector>

#include "model/record.hpp"

namespace arcwall {

/// events.txt: the title, what λ is where that is known (see names_of_lambda()), the events as a table for people, and
/// how each branch ended.
std::string events_text(const Record& record, const std::vector<std::string>& lambda_is = {});

/// What there is to say of an event beside its kind: which contacts change, the type of a branch point, why a branch
/// ends.
std::string event_detail(const RecordEvent& event);

/// `0 → 1`: unstable directions before and after an event, or the one number if they are the same; `?` if unknown.
std::string unstable_change(const RecordEvent& event);

/// The load factor of an event in at most so many digits, none of which is uncertain (apps/output/shown_number.hpp).
std::string shown_lambda(const RecordEvent& event, int digits);

/// What the ± behind a load factor means; empty where no event has one.
std::string uncertainty_note(const Record& record);

/// What a `?` in place of a count means; empty where there is none.
std::string count_note(const Record& record);

/// `w = 1.2 (stop)`: what is known of an end, and its reason.
std::string how_it_ended(const BranchEnd& end);

}  // namespace arcwall
