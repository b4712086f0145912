#pragma once

#include <string>

#include "apps/output/record.hpp"

namespace arcwall {

/// events.txt: the title, the events as a table for people, and how each branch ended.
std::string events_text(const Record& record);

}  // namespace arcwall
