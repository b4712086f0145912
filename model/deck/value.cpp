#include "model/deck/value.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t most_shown = 60;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

std::string escaped(char c) {
  constexpr std::array<char, 16> digits{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F'};
  const auto byte = static_cast<unsigned char>(c);
  if (c == '"' || c == '\\') return {'\\', c};
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  if (byte < 0x20u || byte == 0x7Fu) return {'\\', 'u', '0', '0', digits[byte / 16u], digits[byte % 16u]};
  return {c};
}

}  // namespace

const Value* find(const Value& table, std::string_view key) {
  const auto found =
      std::find_if(table.items.begin(), table.items.end(), [key](const Value& item) { return item.key == key; });
  return found == table.items.end() ? nullptr : &*found;
}

std::string in_quotes(std::string_view text, std::size_t most) {
  std::size_t end = text.size();
  if (most > 0 && end > most) {
    end = most;
    while (end > 0 && continues_a_character(text[end])) --end;
  }
  std::string result = "\"";
  for (const char c : text.substr(0, end)) result += escaped(c);
  return result + (end < text.size() ? "…\"" : "\"");
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '\x7F'; }, ' ');
  return text;
}

std::string key_text(std::string_view key) { return is_name(key) ? std::string(key) : in_quotes(key, most_shown); }

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_name_character);
}

std::string shown(const Value& value) {
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::integer:
      return std::to_string(value.integer);
    case Value::Kind::number:
      return round_trip(value.number);
    case Value::Kind::string:
      return in_quotes(value.string, most_shown);
    case Value::Kind::date:
      return "a date or time";
    case Value::Kind::array:
      return "an array of " + std::to_string(value.items.size());
    case Value::Kind::table:
      return "a table";
  }
  return {};
}

}  // namespace arcwall::deck
