#pragma once

#include <string>
#include <string_view>

#include "model/deck/value.hpp"

namespace arcwall::deck {

/// The root table of a TOML document. Whatever the bytes are, the outcome is a table or an InputError that names
/// `file`.
Value parse_toml(std::string_view text, const std::string& file);

/// The bytes of a regular file of at most 16 MB; InputError otherwise.
std::string read_text_file(const std::string& file);

/// Replaces or adds one value: `assignment` is `dotted.key=value`, the value as in TOML; a number among the parts of
/// the key is an index from 0 where there is an array. What it puts in carries `number` in its positions.
void assign(Value& root, const std::string& assignment, int number);

}  // namespace arcwall::deck
