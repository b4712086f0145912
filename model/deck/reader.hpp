#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

struct Value;

/// Reads and checks a deck; `assignments` are texts `key=value` of `--set`, applied in order. Throws one InputError
/// with all errors: file, line, column, key, value and cure.
Deck read_deck(const std::string& file, const std::vector<std::string>& assignments = {});

/// Reads a deck in memory likewise; `file_name` is for messages only.
Deck read_deck_text(std::string_view text, const std::string& file_name,
                    const std::vector<std::string>& assignments = {});

/// Reads a document of parse_deck() likewise: faster for many decks that differ in their assignments.
Deck read_deck_value(Value root, const std::string& file_name, const std::vector<std::string>& assignments = {});

}  // namespace arcwall::deck
