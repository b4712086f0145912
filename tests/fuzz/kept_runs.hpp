#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "model/model.hpp"

namespace arcwall::fuzz {

struct KeptRun {
  nlohmann::json content;        ///< of its checkpoint
  std::shared_ptr<Model> model;  ///< null where each run needs its own
};

/// The first entries of a content: the version of the program, and what the run is of.
constexpr std::size_t head_entries = 2;

/// Some short runs: contact that slides and that does not, several branches, increments. Made at the first call.
const std::vector<KeptRun>& kept_runs();

}  // namespace arcwall::fuzz
