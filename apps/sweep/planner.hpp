#pragma once

#include <filesystem>
#include <vector>

#include "apps/sweep/case_list.hpp"

namespace arcwall::sweep {

/// A sweep made ready to be run.
struct Plan {
  Sweep sweep{};
  std::string sweep_text{};
  std::string deck_text{};
  std::vector<Case> cases{};
};

/// Reads a sweep and its deck, and builds the model of every case: what is wrong with any of them is in one InputError,
/// with the line of the sweep and the first case. Nothing is traced.
Plan plan(const std::string& sweep_file);

/// Writes what the cases need into a folder: the deck, the sweep, and cases.jsonl last. A folder that holds the same
/// plan is left as it is; OutputError for one that holds anything else.
void write(const Plan& plan, const std::filesystem::path& folder);

}  // namespace arcwall::sweep
