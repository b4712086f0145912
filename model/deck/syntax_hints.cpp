#include "model/deck/syntax_hints.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t most_quoted = 40;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// A place in the text. Columns count characters, whose further bytes begin with the bits 10.
struct TextPlace {
  std::size_t line_begin = 0, line_end = 0, at = 0;
};

std::optional<TextPlace> place_in(std::string_view text, const Position& position) {
  TextPlace place;
  for (int line = 1; line < position.line; ++line) {
    const std::size_t end = text.find('\n', place.line_begin);
    if (end == std::string_view::npos) return std::nullopt;
    place.line_begin = end + 1;
  }
  place.line_end = std::min(text.find('\n', place.line_begin), text.size());
  place.at = place.line_begin;
  for (int column = 1; column < position.column && place.at < place.line_end; ++column) {
    ++place.at;
    while (place.at < place.line_end && (static_cast<unsigned char>(text[place.at]) & 0xC0u) == 0x80u) ++place.at;
  }
  return place;
}

Position position_in(std::string_view text, std::size_t at) {
  Position position{.line = 1, .column = 1};
  for (std::size_t i = 0; i < at; ++i) {
    if (text[i] == '\n') {
      ++position.line;
      position.column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u) {
      ++position.column;
    }
  }
  return position;
}

// Where a string on one line ends, its quote included.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at++];
  while (at < text.size() && text[at] != quote && text[at] != '\n') at += text[at] == '\\' && quote == '"' ? 2 : 1;
  return std::min(at + 1, text.size());
}

// The brackets that are open before a place.
std::vector<std::size_t> open_brackets(std::string_view text, std::size_t before) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < before;) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = behind_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '[' || c == '{') open.push_back(i);
    if ((c == ']' || c == '}') && !open.empty()) open.pop_back();
    ++i;
  }
  return open;
}

// Up to a comment.
std::string_view without_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '#') return trimmed(line.substr(0, i));
    i = line[i] == '"' || line[i] == '\'' ? behind_string(line, i) : i + 1;
  }
  return trimmed(line);
}

bool begins_a_key(std::string_view line) {
  line = trimmed(line);
  const std::size_t end = line.find_first_of("=[]\"',");
  return line.starts_with('[') || (end != std::string_view::npos && end > 0 && line[end] == '=');
}

Diagnostic hint_at(const Position& at, std::string message, std::string cure) {
  return {.line = at.line, .column = at.column, .message = std::move(message), .cure = std::move(cure)};
}

// The array or header that the parser was still in.
std::optional<Diagnostic> missing_bracket(std::string_view text, const TextPlace& place, const Position& refused) {
  const std::string_view line = text.substr(place.line_begin, place.line_end - place.line_begin);
  const std::string_view header = without_comment(line);
  if (header.starts_with('[') && place.at > place.line_begin) {
    const bool two = header.starts_with("[[");
    if (header.ends_with(two ? "]]" : "]")) return std::nullopt;
    const std::string_view name = trimmed(header.substr(0, header.find(']')).substr(two ? 2 : 1));
    return hint_at(refused, "the table header is not closed",
                   "write " + std::string(two ? "[[" : "[") + std::string(name) + (two ? "]]" : "]"));
  }
  const std::vector<std::size_t> open = open_brackets(text, place.at);
  if (open.empty() || open.back() >= place.line_begin || !begins_a_key(line)) return std::nullopt;
  const bool array = text[open.back()] == '[';
  return hint_at(
      position_in(text, open.back()),
      array ? "the array that begins here is not closed" : "the table that begins here is not closed on its line",
      array ? "add ]" : "add }");
}

bool is_decimal_comma(std::string_view value) {
  const std::size_t comma = value.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma + 1 == value.size()) return false;
  return is_digit(value[comma - 1]) && is_digit(value[comma + 1]) &&
         value.find_first_not_of("+-0123456789eE", comma + 1) == std::string_view::npos &&
         value.find_first_not_of("+-0123456789") == comma;
}

// In a table on one line the comma of `a = 2,5` ends the value, and what follows is refused as a key without a value.
std::optional<Diagnostic> decimal_comma_before(std::string_view text, std::size_t at) {
  constexpr std::string_view parts = "+-0123456789eE,";
  std::size_t end = std::min(at, text.size());
  while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
  std::size_t begin = end;
  while (begin > 0 && parts.find(text[begin - 1]) != std::string_view::npos) --begin;
  while (end < text.size() && parts.substr(0, parts.size() - 1).find(text[end]) != std::string_view::npos) ++end;
  const std::string_view value = text.substr(begin, end - begin);
  if (!is_decimal_comma(value)) return std::nullopt;
  std::string meant(value);
  meant[meant.find(',')] = '.';
  return hint_at(position_in(text, begin), "a decimal comma in " + std::string(value), "write " + meant);
}

// The value or the part of it at which the parser stopped: to the line's end where it is not in brackets.
std::string_view refused_value(std::string_view text, const TextPlace& place) {
  const std::string_view line = text.substr(place.line_begin, place.line_end - place.line_begin);
  const bool in_brackets = !open_brackets(text, place.at).empty();
  const std::size_t at = place.at - place.line_begin;
  constexpr std::string_view ends = "[]{},=\"'#";
  std::size_t begin = std::min(at, line.size());
  if (in_brackets) {
    while (begin > 0 && ends.find(line[begin - 1]) == std::string_view::npos) --begin;
    return trimmed(line.substr(begin, line.find_first_of(ends, begin) - begin));
  }
  const std::size_t equals = line.find('=');
  return equals == std::string_view::npos ? std::string_view{} : without_comment(line.substr(equals + 1));
}

// A number and what follows it.
std::size_t number_length(std::string_view value) {
  std::size_t n = value.find_first_not_of("+-0123456789.");
  if (n == std::string_view::npos) return value.size();
  const bool exponent = n > 0 && (value[n] == 'e' || value[n] == 'E') && n + 1 < value.size() &&
                        (is_digit(value[n + 1]) || value[n + 1] == '-' || value[n + 1] == '+');
  if (exponent) n = std::min(value.find_first_not_of("+-0123456789", n + 1), value.size());
  return n;
}

std::optional<Diagnostic> odd_number(std::string_view value, const Position& at) {
  std::string text(value);
  if (is_decimal_comma(value)) {
    text[value.find(',')] = '.';
    return hint_at(at, "a decimal comma in " + std::string(value), "write " + text);
  }
  const std::size_t dot = value.find('.');
  const bool number = !value.empty() && value.find_first_not_of("+-0123456789.eE") == std::string_view::npos;
  if (number && dot != std::string_view::npos) {
    const bool before = dot > 0 && is_digit(value[dot - 1]),
               behind = dot + 1 < value.size() && is_digit(value[dot + 1]);
    if (before == behind) return std::nullopt;
    text.insert(before ? dot + 1 : dot, "0");
    return hint_at(at, "a point without a digit on both sides in " + std::string(value), "write " + text);
  }
  const std::size_t n = number_length(value);
  if (n == 0 || n >= value.size() || !is_digit(value.front() == '-' || value.front() == '+' ? value[1] : value.front()))
    return std::nullopt;
  const std::string_view rest = trimmed(value.substr(n));
  if (std::string_view("*/^").find(rest.front()) != std::string_view::npos)
    return hint_at(at, "a deck does not calculate: " + in_quotes(value, most_quoted) + " is no number",
                   "write its value");
  if (is_letter(rest.front()))
    return hint_at(at, "a number with a unit, " + in_quotes(value, most_quoted),
                   "write the number alone; labels of units stand in [units]");
  return std::nullopt;
}

std::optional<Diagnostic> odd_word(std::string_view value, const Position& at) {
  if (value.empty()) return std::nullopt;
  const char first = value.front();
  if ((first == '"' || first == '\'') && behind_string(value, 0) == value.size() &&
      (value.size() < 2 || value.back() != first))
    return hint_at(at, "a text without its closing quote", std::string("add ") + first);
  if (!is_letter(first)) return std::nullopt;
  constexpr std::array yes{"true", "yes", "on"}, no{"false", "no", "off"};
  const std::string word = lower_case(value);
  for (const auto& [words, meant] : {std::pair(yes, "true"), std::pair(no, "false")})
    if (std::find(words.begin(), words.end(), word) != words.end())
      return hint_at(at, std::string(value) + " is no value", std::string("write ") + meant);
  return hint_at(at, "a text without quotes", "write " + in_quotes(value, most_quoted));
}

// `key: value` and `key value`.
std::optional<Diagnostic> missing_equals(std::string_view line, const Position& at) {
  line = without_comment(line);
  if (line.empty() || line.starts_with('[') || line.find('=') != std::string_view::npos) return std::nullopt;
  const std::size_t end = line.find_first_of(": \t");
  if (end == std::string_view::npos || end == 0) return hint_at(at, "a key without a value", "write key = value");
  return hint_at(at, "a key and no = behind it", "write " + std::string(line.substr(0, end)) + " = …");
}

// [wall] a second time.
std::optional<Diagnostic> repeated_header(std::string_view line, const Position& at) {
  line = without_comment(line);
  for (const char* list : {"load", "wall", "monitor"})
    if (line == "[" + std::string(list) + "]")
      return hint_at(at, "a second [" + std::string(list) + "]",
                     "begin each, the first too, with [[" + std::string(list) + "]]");
  return std::nullopt;
}

}  // namespace

std::optional<Diagnostic> syntax_hint(std::string_view text, const Position& refused) {
  const auto place = place_in(text, refused);
  if (!place) return std::nullopt;
  const std::string_view line = text.substr(place->line_begin, place->line_end - place->line_begin);
  if (auto found = missing_bracket(text, *place, refused)) return found;
  if (auto found = repeated_header(line, refused)) return found;
  if (auto found = missing_equals(line, refused); found && open_brackets(text, place->line_begin).empty()) return found;
  if (const auto open = open_brackets(text, place->at); !open.empty() && text[open.back()] == '{')
    if (auto found = decimal_comma_before(text, place->at)) return found;
  const std::string_view value = refused_value(text, *place);
  const Position begin =
      value.empty() ? refused : position_in(text, static_cast<std::size_t>(value.data() - text.data()));
  if (auto found = odd_number(value, begin)) return found;
  return odd_word(value, begin);
}

}  // namespace arcwall::deck
