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

/// The jumps of these rows. They refer to the record.
std::vector<const RecordJump*> jumps_of_rows(const Record& record);

/// A jump as it stands in events.json.
nlohmann::ordered_json jump_json(const Record& record, const RecordJump& jump);

/// A jump at one λ, from a state to another. It refers to the record.
struct Jump {
  double lambda = 0.0;
  std::vector<double> from{}, to{};    ///< monitors
  const RecordEvent* event = nullptr;  ///< from which the structure jumps, or would have jumped before it returned
  const RecordJump* end = nullptr;
  bool returns = false;  ///< as λ reverses
};

/// All jumps of a record whose ends are known, each followed by its return.
std::vector<Jump> jumps(const Record& record);

}  // namespace arcwall
