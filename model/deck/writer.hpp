#pragma once

#include <string>
#include <string_view>

#include "model/deck/deck.hpp"

namespace arcwall::deck {

/// Returns the deck as a TOML document with all defaults; reading it gives an equal deck. `only`: write that key alone,
/// for example `wall`; empty: all.
std::string to_toml(const Deck& deck, std::string_view only = {});

}  // namespace arcwall::deck
