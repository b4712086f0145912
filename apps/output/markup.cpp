#include "apps/output/markup.hpp"

#include <algorithm>
#include <cstdint>

#include "core/printable.hpp"

namespace arcwall {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

bool can_be_shown(std::uint32_t code) { return code == '\n' || code == '\t' || is_printable(code); }

}  // namespace

std::string plain(std::string_view text, std::size_t most) {
  std::string result;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == most) return result + "…";
    const Utf8Character next = first_character(text);
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
