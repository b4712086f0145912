#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace arcwall::fuzz {

/// The first entries of a content: the version of the program, and what the run is of.
constexpr std::size_t head_entries = 2;

/// The contents of the checkpoints of some short runs: contact that slides and that does not, several branches,
/// increments. Made at the first call.
const std::vector<nlohmann::json>& kept_runs();

}  // namespace arcwall::fuzz
