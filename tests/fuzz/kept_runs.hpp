#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace arcwall::fuzz {

/// The contents of the checkpoints of some short runs: contact that slides and that does not, several branches,
/// increments. Made at the first call.
const std::vector<nlohmann::json>& kept_runs();

}  // namespace arcwall::fuzz
