#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/text_table.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What equilibria beside the traced branches were looked for and found, as a table: a row a value of λ, with the
/// tries and what became of them. Empty where nothing was looked for.
std::vector<TableColumn> search_columns();
std::vector<std::vector<std::string>> search_rows(const Record& record);

/// The equilibria that were found, a row each.
std::vector<TableColumn> found_columns(const Record& record);
std::vector<std::vector<std::string>> found_rows(const Record& record);

/// What they do not say: that nothing found is no proof that nothing is there.
std::string search_note();

/// All of it as it stands in result.json; null where nothing was looked for.
nlohmann::ordered_json search_json(const Record& record);

/// Where a branch begins that leaves no other, `at λ = 6.5, found`; empty of others.
std::string found_at(const Record& record, const RecordBranch& branch);

}  // namespace arcwall
