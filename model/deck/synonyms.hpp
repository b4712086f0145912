#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/deck/value.hpp"

namespace arcwall::deck {

/// Another word for a key of a deck, or for one of the words that a key may have.
struct Synonym {
  enum class Use {
    read,  ///< decks may have it: it is read as the word, which is what is written
    hint,  ///< other programs or books have it: a deck with it is wrong, and the message names the word
  };
  std::string_view other, word;
  Use use = Use::hint;
};

/// All of them.
std::span<const Synonym> synonyms();

/// The word among `candidates` that is meant by another one: as it is read, or as a hint names it. Empty if there is
/// none.
std::string read_as(std::string_view other, const std::vector<std::string>& candidates);
std::string meant_by(std::string_view other, const std::vector<std::string>& candidates);

/// The candidate that is nearest to a misspelt word, by its own letters or by those of a word that is read as it. Empty
/// if none is near.
std::string nearest_meant(std::string_view word, const std::vector<std::string>& candidates);

/// The key that is read for another one in a table, or `other` itself. `table`: as in `--set`, with indices in arrays.
std::string current_key(const std::string& table, const std::string& other);

/// Replaces keys by those that they are read as, in a document or in the value of a key of one. A key that stands
/// beside the one that it is read as stays, so that it is reported.
void use_current_keys(Value& value, const std::string& key = {});

}  // namespace arcwall::deck
