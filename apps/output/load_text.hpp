#pragma once

#include <string>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall {

/// What λ multiplies, in words.
struct LoadText {
  std::string text{};                ///< `load at right force (-1, 0) kN`, `displacement in x of B -1 cm`
  std::string name = "load factor";  ///< of λ where this alone varies: `displacement in x of B`
  std::string size{};                ///< `2 kN`; empty without units, and of a force together with a moment
  std::string key{};                 ///< of the deck, under which its numbers stand: `load.0`, `wall.hill.motion`
};

/// A number with its unit; alone where the deck has no units.
std::string with_unit(const std::string& number, const std::string& unit);

LoadText load_text(const deck::Load& load, const deck::Units& units);
LoadText movement_text(const deck::Prescribed& moved, const deck::Units& units);
LoadText movement_text(const deck::Wall& wall, const deck::Units& units);  ///< of one that moves

/// A spring in words: `at mid: z 2.5 kN/cm`.
std::string spring_text(const deck::Spring& spring, const deck::Units& units);

/// All that λ multiplies, in one of the deck's stages or in any.
std::vector<LoadText> driven_by_lambda(const deck::Deck& deck, const deck::Stage* stage = nullptr);

/// What λ is where one thing alone varies that has a name: `displacement in x of B, times 2 cm`; else empty.
std::string name_of_lambda(const deck::Deck& deck, const deck::Stage* stage = nullptr);

/// λ as the title of an axis, with what it multiplies where that is one thing: `load factor λ, times 2 kN`.
std::string title_of_lambda(const std::vector<LoadText>& driven);

/// Returns true if λ moves supports or walls, and no load depends on it.
bool is_movement(const std::vector<LoadText>& driven);

/// That of each stage, or of a deck without any.
std::vector<std::string> names_of_lambda(const deck::Deck& deck);

}  // namespace arcwall
