#pragma once

#include <string>
#include <vector>

#include "apps/output/text_table.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What λ of the events depends on, as a table for people: one row an event and a number of the deck.
std::vector<TableColumn> sensitivity_columns(const Record& record);
std::vector<std::vector<std::string>> sensitivity_rows(const Record& record);

/// By how many per cent λ of an event changes where a number grows by one; empty where that means nothing.
std::string per_cent(const RecordEvent& event, const RecordSensitivity& sensitivity);

}  // namespace arcwall
