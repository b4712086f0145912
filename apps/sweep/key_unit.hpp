#pragma once

#include <string>

#include "model/deck/deck.hpp"

namespace arcwall::sweep {

/// The unit of what a key of the deck holds, by the labels of [units]: `cm` of `wall.0.profile.z`; empty of what has
/// none, and without labels.
std::string unit_of_key(const std::string& key, const deck::Units& units);

}  // namespace arcwall::sweep
