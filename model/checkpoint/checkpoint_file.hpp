#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace arcwall {

/// The bytes of a checkpoint: a line of text that says what it is, the length and the CRC-32 of what follows, and the
/// content as CBOR.
std::string to_checkpoint(const nlohmann::json& content);

/// The content again. Throws OutputError, which names `file`, for bytes that are not those of a whole checkpoint: no
/// change of one bit and no truncation is taken.
nlohmann::json from_checkpoint(std::string_view bytes, const std::string& file);

/// The deck that a checkpoint is of; all empty for other bytes.
struct DeckOfCheckpoint {
  std::string file{};  ///< its name, without folder
  std::string path{};  ///< whole; empty where the deck is not from a file
  std::string text{};
};
DeckOfCheckpoint deck_of_checkpoint(std::string_view bytes);

/// The content of CBOR bytes. Throws BadArchive for others, also for such as nest deeper than a checkpoint does.
nlohmann::json from_cbor(std::string_view bytes);

}  // namespace arcwall
