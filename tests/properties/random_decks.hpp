#pragma once

#include <rapidcheck.h>

#include "model/deck/deck.hpp"

/// Small structures at random: what a few elements show of trusses, toggles, arches, frames, and columns among walls.
namespace arcwall::test {

/// Uniform in [low, high], a million values; shrinks towards low.
rc::Gen<double> between(double low, double high);

/// Any of the following. Points that are supported are held in x and z at least, so that every rigid motion of the deck
/// is a deck. Paths end at a bound of λ or after some dozens of points.
rc::Gen<deck::Deck> small_deck();

/// Two bars, flat or steep, that a force pushes through the line between their supports.
rc::Gen<deck::Deck> truss_deck();

/// The same of two beams, pinned or clamped, of any theory.
rc::Gen<deck::Deck> toggle_deck();

/// A beam along an arc, a sine wave or a spline between two supports, loaded at its middle.
rc::Gen<deck::Deck> arch_deck();

/// Two columns and a beam between them, loaded down and aside at a corner.
rc::Gen<deck::Deck> portal_deck();

/// A beam with an imperfection between two supports, which a force pushes against a wall, or one of two.
rc::Gen<deck::Deck> walled_deck();

}  // namespace arcwall::test

namespace rc {

template <>
struct Arbitrary<arcwall::deck::Deck> {
  static Gen<arcwall::deck::Deck> arbitrary() { return arcwall::test::small_deck(); }
};

}  // namespace rc

namespace arcwall::deck {

/// A deck that fails is shown as text to run.
void showValue(const Deck& deck, std::ostream& out);

}  // namespace arcwall::deck
