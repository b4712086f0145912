#pragma once

#include <string>

#include "model/deck/deck.hpp"

/// The same structure told otherwise: what these make of a deck has the same path. They know what random_decks.hpp
/// makes: point loads, straight and round walls, supports that hold x and z together.
namespace arcwall::test {

/// x ↦ R x + shift, R a turn by `angle`, after z ↦ −z if `mirrored`.
struct Isometry {
  double angle = 0.0;
  bool mirrored = false;
  deck::Vector shift{};

  deck::Vector turned(const deck::Vector& v) const;  ///< of a free vector
  deck::Vector moved(const deck::Vector& p) const;   ///< of a point
};

/// With all that is in it moved. Walls stay less than upright.
deck::Deck moved(deck::Deck deck, const Isometry& isometry);

/// In other units, of which an old one has so many.
deck::Deck in_units(deck::Deck deck, double length, double force);

/// With the other sign of all loads that vary, and of λ.
deck::Deck with_opposite_loads(deck::Deck deck);

/// With the member in the other direction.
deck::Deck with_reversed_member(deck::Deck deck, const std::string& name);

}  // namespace arcwall::test
