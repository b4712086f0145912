#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

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

/// The place of a deck's file as JSON; null where the deck is not from one.
nlohmann::ordered_json path_json(const std::string& path);

/// The checksum by which a deck's text is known again.
std::string crc32_text(std::string_view text);

}  // namespace arcwall
