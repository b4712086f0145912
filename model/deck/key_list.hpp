#pragma once

#include <string>
#include <vector>

#include "model/deck/keys.hpp"

namespace arcwall::deck {

/// What the declaration of a key says.
struct DeclaredKey {
  enum class Kind {
    value,
    table,            ///< `[contact]`
    inner_table,      ///< `control = { at = "P", component = "z" }`
    array_of_tables,  ///< `[[load]]`
    named_tables,     ///< `[member.NAME]`
  };

  std::string table{};  ///< `contact`, `member.*` for any name, `load.#` for any index; empty: the root
  std::string name{};   ///< `*`: any name
  Kind kind = Kind::value;
  std::string option{};  ///< the word with which the key belongs to the table; empty: always
  std::string option_meaning{};
  std::string meaning{};
  bool required = true;
  std::string otherwise{};  ///< if the key is left out: the value as TOML has it, or in words
  bool otherwise_in_words = false;
  Dimension unit{};
  std::vector<std::string> words{};  ///< that the value may be

  std::string path() const { return (table.empty() ? "" : table + ".") + name; }

  /// Whether a key as of `--set` is this one, or a value of its array.
  bool is(const std::string& key) const;
};

/// All keys of a deck, in the order of a deck that is written. They are put together once.
const std::vector<DeclaredKey>& declared_keys();

/// A part of the root as a deck begins it: `title`, `[contact]`, `[[load]]`, `[member.NAME]`.
std::string beginning(const DeclaredKey& part);

/// What the number of a key as of `--set` is measured in: `kN/cm²`; empty where it has no unit, or the deck names none.
std::string unit_of_key(const std::string& key, const Units& units);

/// A dimension in the deck's units: `cm`, `kN cm`, `1/cm`; empty without one, or where the deck does not name both.
std::string unit_text(const Dimension& dimension, const Units& units);

}  // namespace arcwall::deck
