#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "apps/verify/verify.hpp"
#include "model/run_description.hpp"

namespace arcwall::verify {

/// Holds events.json, result.json and deck.toml against what the record, the model and the deck's text say: every key,
/// number by number to twelve digits. Left out of result.json are times and versions.
void check_copies(const Model& model, const Record& record, const RunDescription& run, const StoredFiles& files,
                  Findings& findings);

/// Holds a JSON text against what it should be: every key, number by number to twelve digits, but for those named.
void check_json(const std::string& check, const std::string& text, nlohmann::ordered_json expected,
                const std::vector<std::string>& but, Findings& findings);

}  // namespace arcwall::verify
