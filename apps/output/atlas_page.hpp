#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "model/atlas.hpp"

namespace arcwall {

/// atlas.json: how the branches of a run hang together.
nlohmann::ordered_json atlas_json(const Record& record, const Atlas& atlas);

/// The same for the report: a picture with a line a node over λ, and which states are stable where. Empty of runs
/// without nodes.
std::string atlas_section(const Record& record, const Atlas& atlas);

}  // namespace arcwall
