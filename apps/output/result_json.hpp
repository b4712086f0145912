#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/output/files.hpp"
#include "model/model.hpp"
#include "model/record.hpp"
#include "model/run_description.hpp"

namespace arcwall {

/// Wall-clock times [s].
struct RunSeconds {
  double total = 0.0;
  double tracing = 0.0;
};

/// result.json: what was run, with which program, and how it ended. `status`: the exit status.
nlohmann::ordered_json result_json(const Model& model, const RunDescription& run, const Record& record,
                                   const RunSeconds& seconds, int status);

/// Which deck results are of, and what `--set` changed in it; `path` is null where the deck is not from a file.
nlohmann::ordered_json deck_json(const DeckIdentity& deck, const std::string& title,
                                 const std::vector<std::string>& assignments);

/// The checksum by which a deck's text is known again.
std::string crc32_text(std::string_view text);

}  // namespace arcwall
