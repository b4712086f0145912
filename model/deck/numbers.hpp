#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/deck/keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

/// A number of a deck that may have any value near its own.
struct DeckNumber {
  std::string key{};  ///< as in `--set`, with indices for the names of walls and loads
  double value = 0.0;
  Dimension unit{};
  /// The numbers that change with a variable, and how fast.
  std::vector<std::pair<DeckNumber, double>> enters{};
};

/// Why a key names no such number or no part, and what would be right.
struct NoNumber {
  std::string message{}, cure{};
};

/// A part of a deck's text.
struct DeckPart {
  const Value* value = nullptr;
  std::string key{};  ///< as in `--set`, with indices for the names of walls and loads
};

/// The part of a document behind a key as in `--set`, as far as the document has it.
std::variant<DeckPart, NoNumber> part_of(const Value& root, const std::string& key);

/// The one way to write a key as in `--set`: parts of arrays by their indices, as far as the document has them.
std::string written_key(const Value& root, const std::string& key);

/// The number behind a key as in `--set`, also where the deck's text leaves it to its default.
std::variant<DeckNumber, NoNumber> number_of(const Deck& deck, const std::string& key);

/// The deck with another value of a number. Throws InputError where that makes a wrong deck.
Deck with_number(const Deck& deck, const DeckNumber& number, double value);

/// The same of a deck that is a text.
Deck with_number(const std::string& text, const std::string& file, const DeckNumber& number, double value);

}  // namespace arcwall::deck
