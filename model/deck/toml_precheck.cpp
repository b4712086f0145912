#include "model/deck/toml_precheck.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

// Length of the UTF-8 sequence at the start of `text`, or 0 if it is none: a stray or missing continuation, an overlong
// form, a surrogate or a code point above U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80u) return 1;
  const std::size_t length = first >= 0xF0u ? 4 : first >= 0xE0u ? 3 : 2;
  if (first < 0xC2u || first > 0xF4u || text.size() < length) return 0;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
    code = (code << 6u) | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800u) || (length == 4 && code < 0x10000u);
  const bool surrogate = code >= 0xD800u && code <= 0xDFFFu;
  return overlong || surrogate || code > 0x10FFFFu ? 0 : length;
}

// Walks through the text once: bytes are checked everywhere, structure only outside strings and comments.
class Scanner {
 public:
  Scanner(std::string_view text, const TextLimits& limits) : text_(text), limits_(limits) {}

  std::optional<Diagnostic> scan() {
    while (at_ < text_.size() && !problem_) {
      const char c = text_[at_];
      if (!take_character()) break;
      if (c == '"' || c == '\'') {
        take_string(c);
      } else if (c == '#') {
        take_comment();
      } else {
        see_structure(c);
      }
    }
    return problem_;
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\n'; }

  void fail(std::string message, std::string cure) {
    problem_ = Diagnostic{.line = line_, .column = column_, .message = std::move(message), .cure = std::move(cure)};
  }

  // One character of any kind; false if it is not allowed anywhere in TOML.
  bool take_character() {
    const char c = text_[at_];
    const std::size_t length = utf8_length(text_.substr(at_));
    if (length == 0) {
      fail("a byte that is not UTF-8", "save the file as UTF-8");
    } else if (c == '\n') {
      ++line_;
      column_ = 1;
      line_begin_ = at_ + 1;
    } else if (c == '\0') {
      fail("a NUL byte: this is not a text file", "give a TOML file");
    } else if ((c >= '\0' && c < ' ' && c != '\t' && !(c == '\r' && peek(1) == '\n')) || c == '\x7F') {
      fail("a control character (" + in_quotes(text_.substr(at_, 1)) + ")", "remove it");
    } else if (at_ + length - line_begin_ > limits_.line_bytes) {
      column_ = 1;
      fail("the line is longer than " + std::to_string(limits_.line_bytes) + " bytes", "break it into several lines");
    } else {
      ++column_;
    }
    at_ += length;
    return !problem_;
  }

  bool next_are(char c, int count) const {
    for (int i = 0; i < count; ++i) {
      if (peek(static_cast<std::size_t>(i)) != c) return false;
    }
    return true;
  }

  // The rest of a string whose first quote is taken. One on a single line ends there, closed or not: the parser will
  // say so.
  void take_string(char quote) {
    const bool multi_line = next_are(quote, 2);
    if (multi_line) take_characters(2);
    while (at_ < text_.size() && !problem_) {
      const char c = text_[at_];
      if (!multi_line && c == '\n') return;
      if (multi_line && next_are(quote, 3)) {
        take_characters(3);
        while (peek() == quote) take_character();  // up to two more belong to the text
        return;
      }
      if (!take_character()) return;
      if (!multi_line && c == quote) return;
      if (c == '\\' && quote == '"' && at_ < text_.size() && text_[at_] != '\n') take_character();
    }
  }

  void take_characters(int count) {
    for (int i = 0; i < count; ++i) take_character();
  }

  void take_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') {
      if (!take_character()) return;
    }
  }

  void see_structure(char c) {
    if (c == '[' || c == '{') {
      if (c == '[' && starts_line_) see_header();
      if (++depth_ > limits_.depth) fail("brackets nested deeper than " + std::to_string(limits_.depth), "use fewer");
    } else if (c == ']' || c == '}') {
      depth_ = std::max(0, depth_ - 1);
    }
    if (c == '.') {
      if (++dots_ >= limits_.key_parts)
        fail("a key of more than " + std::to_string(limits_.key_parts) + " parts", "use fewer");
    } else if (std::string_view("[]{}=,\n").find(c) != std::string_view::npos) {
      dots_ = 0;
    }
    if (c == '\n') {
      starts_line_ = depth_ == 0;
    } else if (c != ' ' && c != '\t') {
      starts_line_ = false;
    }
  }

  // `[` or `[[` must be followed by a key; the parser takes that for granted.
  void see_header() {
    std::size_t ahead = peek() == '[' ? 1 : 0;
    while (peek(ahead) == ' ' || peek(ahead) == '\t') ++ahead;
    const char c = peek(ahead);
    if (c == '"' || c == '\'' || is_name({&c, 1})) return;
    fail("a table header without a name", "write [name] or [[name]]");
  }

  std::string_view text_;
  TextLimits limits_;
  std::optional<Diagnostic> problem_{};
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  int column_ = 1;
  int depth_ = 0;
  int dots_ = 0;
  bool starts_line_ = true;
};

}  // namespace

std::optional<Diagnostic> precheck(std::string_view text, const TextLimits& limits) {
  if (text.size() > limits.bytes) {
    return Diagnostic{.message = "is larger than " + std::to_string(limits.bytes >> 20u) + " MB",
                      .cure = "give a deck, not the data it was made from"};
  }
  return Scanner(text, limits).scan();
}

}  // namespace arcwall::deck
