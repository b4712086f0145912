#pragma once

#include <string>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

/// The deck as a TOML document in which every default stands; reading it gives an equal deck.
std::string to_toml(const Deck& deck);

}  // namespace arcwall::deck
