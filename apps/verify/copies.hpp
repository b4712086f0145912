#pragma once

#include <string_view>

#include "apps/verify/verify.hpp"

namespace arcwall::verify {

/// Holds events.json, result.json and deck.toml against what the record, the model and the deck's text say: every key,
/// number by number to twelve digits. Left out of result.json are times and versions.
void check_copies(const Model& model, const Record& record, std::string_view deck_text, const StoredFiles& files,
                  Findings& findings);

}  // namespace arcwall::verify
