#include "apps/output/markup.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace arcwall {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
  std::size_t bytes = 1;
  std::optional<std::uint32_t> code{};  // empty: no UTF-8
};

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u; }

// The first character of a text that is not empty. Codes that are too long, surrogates and those beyond U+10FFFF are
// no UTF-8.
Character first_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80u) return {.code = lead};
  const std::size_t bytes = lead >= 0xF0u ? 4 : lead >= 0xE0u ? 3 : 2;
  if (lead < 0xC2u || lead > 0xF4u || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text[i])) return {};
    code = code << 6u | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  }
  const std::uint32_t least = bytes == 4 ? 0x10000u : bytes == 3 ? 0x800u : 0x80u;
  if (code < least || code > 0x10FFFFu || (code >= 0xD800u && code <= 0xDFFFu)) return {};
  return {.bytes = bytes, .code = code};
}

bool can_be_shown(std::uint32_t code) {
  if (code == '\n' || code == '\t') return true;
  const bool control = code < 0x20u || (code >= 0x7Fu && code < 0xA0u);
  const bool line = code == 0x2028u || code == 0x2029u;
  const bool direction = code == 0x061Cu || code == 0x200Eu || code == 0x200Fu ||
                         (code >= 0x202Au && code <= 0x202Eu) || (code >= 0x2066u && code <= 0x2069u);
  return !control && !line && !direction;
}

}  // namespace

std::string plain(std::string_view text, std::size_t most) {
  std::string result;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == most) return result + "…";
    const Character next = first_character(text);
    result += next.code && can_be_shown(*next.code) ? text.substr(0, next.bytes) : replacement;
    text.remove_prefix(next.bytes);
  }
  return result;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string script_json(const nlohmann::ordered_json& json) {
  constexpr bool ascii = true;
  const std::string text = json.dump(-1, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0, special; at < text.size(); at = special + 1) {
    special = std::min(text.find_first_of("<>&", at), text.size());
    result.append(text, at, special - at);
    if (special < text.size())
      result += text[special] == '<' ? "\\u003c" : text[special] == '>' ? "\\u003e" : "\\u0026";
  }
  return result;
}

}  // namespace arcwall
