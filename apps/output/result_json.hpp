#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Wall-clock times [s].
struct RunSeconds {
  double total = 0.0;
  double tracing = 0.0;
};

/// result.json: what was run, with which program, and how it ended. `deck_text`: the bytes of the deck's file;
/// `status`: the exit status.
nlohmann::ordered_json result_json(const Model& model, std::string_view deck_text, const Record& record,
                                   const RunSeconds& seconds, int status);

/// The checksum by which a deck's text is known again.
std::string crc32_text(std::string_view text);

}  // namespace arcwall
