#include "model/checkpoint/checkpoint_file.hpp"

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/error.hpp"
#include "model/checkpoint/archive.hpp"

namespace arcwall {

using Json = nlohmann::json;

namespace {

constexpr std::string_view any_version = "arcwall checkpoint ", first_line = "arcwall checkpoint 31\n";
constexpr std::size_t length_bytes = 8, crc_bytes = 4, head_bytes = first_line.size() + length_bytes + crc_bytes;

// Little-endian whatever the machine.
std::string to_bytes(std::uint64_t number, std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<char>((number >> (8 * i)) & 0xff));
  return bytes;
}

std::uint32_t crc32_of(std::string_view a, std::string_view b) {
  const auto next = [](uLong crc, std::string_view text) {
    return ::crc32_z(crc, reinterpret_cast<const Bytef*>(text.data()), text.size());
  };
  return static_cast<std::uint32_t>(next(next(0, a), b));
}

// That content takes as CBOR, which begins each value with nine bytes at most.
std::size_t most_bytes(const Json& content) {
  constexpr std::size_t begin = 9;
  std::size_t bytes = begin;
  if (content.is_binary()) bytes += content.get_binary().size();
  if (content.is_string()) bytes += content.get_ref<const std::string&>().size();
  if (content.is_structured())
    for (const Json& part : content) bytes += most_bytes(part);
  return bytes;
}

// Whether CBOR nests no deeper than `most`, and no list claims more items than there are bytes, as far as it can be
// read: the parser calls itself for each level, and throws for a size that memory cannot hold though it is told not to
// throw.
bool is_moderate(std::string_view bytes, std::size_t most) {
  constexpr unsigned byte_string = 2, text = 3, array = 4, map = 5, tag = 6;  // major types (RFC 8949, 3.1)
  std::vector<std::uint64_t> left;                                            // items still to come, a level each
  for (std::size_t at = 0; at < bytes.size();) {
    const auto head = static_cast<std::uint8_t>(bytes[at++]);
    const unsigned kind = head >> 5, size = head & 31;
    std::uint64_t value = size;
    if (size >= 24 && size <= 27) {
      value = 0;
      for (std::size_t i = 0; i < (std::size_t{1} << (size - 24)) && at < bytes.size(); ++i)
        value = (value << 8) | static_cast<std::uint8_t>(bytes[at++]);
    } else if (size > 27) {
      return false;  // of indefinite length: never written
    }
    if (kind == tag) return false;
    if (kind == byte_string || kind == text) {
      if (value > bytes.size() - at) return true;  // the parser says what is wrong
      at += static_cast<std::size_t>(value);
    }
    const bool opens = (kind == array || kind == map) && value > 0;
    if (opens) {
      if (value > bytes.size()) return false;
      left.push_back(kind == map ? 2 * value : value);
      if (left.size() > most) return false;
      continue;
    }
    while (!left.empty() && --left.back() == 0) left.pop_back();
  }
  return true;
}

}  // namespace

// In one string that does not have to grow: a long run of a fine mesh has as many bytes as all of its states.
std::string to_checkpoint(const Json& content) {
  std::string bytes(first_line);
  bytes.reserve(head_bytes + most_bytes(content));
  bytes.resize(head_bytes);
  Json::to_cbor(content, bytes);
  const std::string_view payload = std::string_view(bytes).substr(head_bytes);
  const std::string length = to_bytes(payload.size(), length_bytes);
  const std::string crc = to_bytes(crc32_of(length, payload), crc_bytes);
  bytes.replace(first_line.size(), length_bytes + crc_bytes, length + crc);
  return bytes;
}

Json from_checkpoint(std::string_view bytes, const std::string& file) {
  const auto refuse = [&](const std::string& what) -> Json {
    throw OutputError(file + ": " + what + "; run the deck again");
  };
  if (!bytes.starts_with(any_version)) return refuse("is no checkpoint of this program");
  if (!bytes.starts_with(first_line)) return refuse("is a checkpoint of another version of this program");
  if (bytes.size() < head_bytes) return refuse("is damaged: it is not whole");
  const std::string_view length = bytes.substr(first_line.size(), length_bytes), payload = bytes.substr(head_bytes);
  const std::string_view crc = bytes.substr(first_line.size() + length_bytes, crc_bytes);
  if (length != to_bytes(payload.size(), length_bytes)) return refuse("is damaged: it is not whole");
  if (crc != to_bytes(crc32_of(length, payload), crc_bytes)) return refuse("is damaged: its bytes have changed");
  try {
    return from_cbor(payload);
  } catch (const BadArchive& problem) {
    return refuse(std::string("is no checkpoint: ") + problem.what());
  }
}

DeckOfCheckpoint deck_of_checkpoint(std::string_view bytes) try {
  const Json content = from_checkpoint(bytes, "");
  const auto text = [&](const char* pointer) {
    const auto at = Json::json_pointer(pointer);
    return content.contains(at) && content.at(at).is_string() ? content.at(at).get<std::string>() : std::string();
  };
  DeckOfCheckpoint deck;
  deck.file = std::filesystem::path(text("/1/0")).filename().string();
  deck.text = text("/1/1");
  deck.path = text("/1/2");
  return deck;
} catch (const OutputError&) {
  return {};
}

Json from_cbor(std::string_view bytes) {
  constexpr std::size_t deepest = 100;
  if (!is_moderate(bytes, deepest)) throw BadArchive("content that is no checkpoint's");
  Json content = Json::from_cbor(bytes, true, false);
  if (content.is_discarded()) throw BadArchive("content that is no CBOR");
  return content;
}

}  // namespace arcwall
