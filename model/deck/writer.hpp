#pragma once

#include <string>
#include <string_view>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

/// The deck as a TOML document in which every default stands; reading it gives an equal deck. With `only` no more than
/// that key of the document, as `wall`.
std::string to_toml(const Deck& deck, std::string_view only = {});

}  // namespace arcwall::deck
