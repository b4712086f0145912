#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace arcwall {

/// The first character of a text in UTF-8.
struct Utf8Character {
  std::size_t bytes = 1;
  std::optional<std::uint32_t> code{};  ///< empty: the byte is no UTF-8
};

/// Of a text that is not empty. Codes that are written too long, surrogates and those beyond U+10FFFF are no UTF-8.
Utf8Character first_character(std::string_view text);

/// Whether a character can stand in a line of text as it is: no control character, no end of a line, and none that
/// turns the direction of writing.
bool is_printable(std::uint32_t code);

enum class LineBreaks {
  kept,    ///< of a text of several lines: a line break stays, and a tab
  escaped  ///< of one that has to stay on one line
};

/// A text that a terminal shows and does not obey: what is not printable is written as `\n`, `\t`, `\u001B`, `\u202E`,
/// and bytes that are not UTF-8 as `\xFF`.
std::string printable(std::string_view text, LineBreaks breaks = LineBreaks::escaped);

}  // namespace arcwall
