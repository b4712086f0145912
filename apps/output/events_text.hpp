#pragma once

#include <string>

#include "apps/output/record.hpp"

namespace arcwall {

/// events.txt: the title, the events as a table for people, and how each branch ended.
std::string events_text(const Record& record);

/// `w = 1.2 (stop)`: what is known of an end, and its reason.
std::string how_it_ended(const BranchEnd& end);

}  // namespace arcwall
