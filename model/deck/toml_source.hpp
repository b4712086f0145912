#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/deck/value.hpp"

namespace arcwall::deck {

/// The root table of a TOML document. Whatever the bytes are, the outcome is a table or an InputError that names
/// `file`.
Value parse_toml(std::string_view text, const std::string& file);

/// That of a deck, with keys in place of those that are read as them.
Value parse_deck(std::string_view text, const std::string& file);

/// The bytes of a regular file of at most 16 MB; InputError otherwise.
std::string read_text_file(const std::string& file);

/// What a part of a dotted key means in an array: the element with that index, from 0, or the table with that `name`.
/// Null if there is none.
const Value* element_of(const Value& array, const std::string& part);

/// The parts of a key as in `--set`. One part alone may be the name of a variable, which is in `variables`.
std::vector<std::string> with_table_of_variables(const Value& root, std::vector<std::string> parts);

/// Replaces or adds one value: `assignment` is `dotted.key=value`, the value as in TOML; where there is an array a part
/// of the key is an index from 0, or the name of one of its tables. Keys that are read as others are those. What it
/// puts in carries `number` in its positions.
void assign(Value& root, const std::string& assignment, int number);

}  // namespace arcwall::deck
