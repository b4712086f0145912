#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall::explore {

/// A number that stands in the text of a deck.
struct WrittenNumber {
  std::string key{};  ///< as in `--set`, with the names of tables in arrays
  std::string unit{};
  double value = 0.0;
  bool whole = false;  ///< written as a whole number, where a number without unit may be a count
  deck::Position position{};
};

/// The finite numbers of a deck's text: those of `[variables]` first, the others in the order of the text. At most
/// `most`. Throws InputError if the text is no TOML.
std::vector<WrittenNumber> written_numbers(std::string_view text, const std::string& file, std::size_t most);

}  // namespace arcwall::explore
