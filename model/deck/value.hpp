#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

/// One value of a TOML document, with its place; tables keep the order of the document.
struct Value {
  enum class Kind { boolean, integer, number, string, date, array, table };

  Kind kind = Kind::table;
  Position position{};
  std::string key{};        ///< in the table it stands in; empty in an array
  Position key_position{};  ///< likewise
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;         ///< of an integer too; may be nan or infinite
  std::string string{};        ///< UTF-8
  std::vector<Value> items{};  ///< of an array; of a table, every key once
};

/// The value with that key in a table, or null.
const Value* find(const Value& table, std::string_view key);

/// The value as a message shows it: short, on one line, printable.
std::string shown(const Value& value);

/// Text in quotes as TOML writes it, on one line and printable; cut after `most` bytes if that is not 0.
std::string in_quotes(std::string_view text, std::size_t most = 0);

/// The text with a space for every control character.
std::string on_one_line(std::string text);

/// `key`, quoted if TOML needs that.
std::string key_text(std::string_view key);

/// Letters, digits, `_` and `-`, and at least one.
bool is_name(std::string_view text);

}  // namespace arcwall::deck
