#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/text_table.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Where structures fall to, as a table: a row an event that has a jump, or one each where it has several. Empty
/// where none has.
std::vector<TableColumn> jump_columns(const Record& record);
std::vector<std::vector<std::string>> jump_rows(const Record& record);

/// A jump as it stands in events.json.
nlohmann::ordered_json jump_json(const Record& record, const RecordJump& jump);

/// A fall at one λ: from a point of the curve to another.
struct Jump {
  double lambda = 0.0;
  std::vector<double> from{}, to{};  ///< monitors
};

/// All falls of a record, those of the ways back among them.
std::vector<Jump> jumps(const Record& record);

}  // namespace arcwall
