#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/output/report_content.hpp"

/// Tables of a run, and the tree of its branches, as elements of HTML.
namespace arcwall {

std::vector<const RecordEvent*> all_events(const Record& record);

/// `columns`: how many monitors are there.
std::string event_rows(const Record& record, const std::vector<const RecordEvent*>& events, std::size_t columns);
std::string event_titles(const Record& record, std::size_t columns);
std::string event_note(const Record& record);

/// Sections; empty without rows.
std::string sensitivities(const Record& record);
std::string jump_table(const Record& record);

/// The branches that leave a branch, and those that leave them in turn.
std::string branch_tree(const Record& record, std::optional<Index> parent);

}  // namespace arcwall
