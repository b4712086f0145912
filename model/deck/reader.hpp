#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

struct Value;

/// Reads and checks a deck; `assignments` are the texts of `--set key=value`, applied in their order. Everything that
/// is wrong is in one InputError: file, line, column, key, the value found and what would be right.
Deck read_deck(const std::string& file, const std::vector<std::string>& assignments = {});

/// The same for a deck in memory; `file_name` is only named in messages.
Deck read_deck_text(std::string_view text, const std::string& file_name,
                    const std::vector<std::string>& assignments = {});

/// The same of a document that parse_deck() has read: many decks that differ in their assignments are read sooner.
Deck read_deck_value(Value root, const std::string& file_name, const std::vector<std::string>& assignments = {});

}  // namespace arcwall::deck
