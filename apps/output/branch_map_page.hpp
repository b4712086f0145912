#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "answers/branch_map.hpp"

namespace arcwall {

/// branches.json: how the branches of a run hang together.
nlohmann::ordered_json branch_map_json(const Record& record, const BranchMap& map);

/// The same for the report: a picture with a line a segment over λ, and which states are stable where. Empty of runs
/// without segments.
std::string branch_map_section(const Record& record, const BranchMap& map);

}  // namespace arcwall
