#pragma once

#include <memory>
#include <string>
#include <vector>

#include "elements/structure.hpp"
#include "model/deck/deck.hpp"

namespace arcwall {

/// How bodies that nothing but contact holds are kept where they are as far as neither contact nor loads say where they
/// go: by springs to the ground at ends of members, in the directions in which these can move without strain; where
/// there is no end, at two nodes far from walls. The springs are so soft that their forces do not count beside those
/// that deform the softest member, or the body where that is softer, as with a weak tie; and stiff enough for the
/// equations to have one solution.
struct LooseHolds {
  static constexpr double softness = 1e-7;  ///< beside what is softest; 1000 times as much in decks without loads
  /// By so many times the structure's size bodies may move before they count as adrift: a wall may be that far.
  static constexpr int farthest = 20;

  struct Hold {
    deck::Place at{};
    deck::Stiffness stiffness{};
  };
  std::vector<Hold> holds{};

  bool empty() const { return holds.empty(); }

  /// Of the stiffest spring [force/length].
  double stiffness() const;

  /// The same with springs of which the stiffest one is this stiff [force/length].
  LooseHolds with_stiffness(double stiffest) const;

  /// As springs of a deck.
  std::vector<deck::Spring> springs() const;

  /// What the user should know of them.
  std::string warning(const deck::Deck& deck) const;
};

/// Those of a deck whose structure can move without strain; none if no wall concerns it, if its contact knows no such
/// bodies, or if they would not hold it.
LooseHolds loose_holds(const deck::Deck& deck);

/// Of a mechanism that what is constant may stiffen, as a cable that is stretched: springs at all its joints. None if
/// nothing is constant, or if they would not hold it.
LooseHolds holds_until_stiffened(const deck::Deck& deck);

/// The force by which the most flexible member resists a displacement of one of its ends: 3 EI/ℓ³ of a cantilever, of a
/// bar EA/ℓ [force/length]. `structure` is that of the deck.
double softest_stiffness(const deck::Deck& deck, const Structure& structure);

/// The sum of the constant loads on a deck's structure, as they are at rest [force].
Vec2 constant_resultant(const deck::Deck& deck);

}  // namespace arcwall
