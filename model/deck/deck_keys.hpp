#pragma once

#include <string>
#include <vector>

#include "model/deck/deck.hpp"
#include "model/deck/keys.hpp"

/// The declarations of all keys of a deck, with the checks of what is read. Later parts look up what earlier ones have
/// read.
namespace arcwall::deck {

void declare_keys(Keys& root, Deck& deck);

// Its parts, in the order of the deck that is written.
void declare_sections(Keys& root, Deck& deck);  ///< labels, materials, sections and points: what refers to nothing else
void declare_members(Keys& root, Deck& deck);
bool declare_loads(Keys& root, Deck& deck);  ///< supports and their movements, too; true if all are right
void declare_springs(Keys& root, Deck& deck);
bool declare_walls(Keys& root, Deck& deck);  ///< and the treatment of contact; true if all walls are right
void declare_path(Keys& root, Deck& deck);   ///< and the monitors

void declare_curve(Keys& root, Deck& deck);  ///< the event that is followed

/// Reports a deck in which λ drives nothing. What a wrong load would have been cannot be told: only where all are
/// right.
void check_driven(Keys& root, const Deck& deck);

/// Reports movements of one direction of which one would do.
void check_movements(Keys& root, const Deck& deck);

/// Whether one of driven_things() is other than zero.
bool varies(const Deck& deck, const std::string& thing);

/// The outline of a wall, if it has one, and what rounds its corners.
void outline_keys(Keys& keys, Wall& wall);

/// An array x of the keys x and z: two lists of the same length, at least 2.
bool curve_keys(Keys& keys, std::vector<double>& x, std::vector<double>& z);

/// What a reader has replaced by these lists before: points of a file or of a list, and smoothing.
void given_points_keys(Keys& keys, bool smooths);

/// The first of these members whose section has no height, or null.
const Member* member_without_faces(const Deck& deck, const std::vector<const Member*>& members);

}  // namespace arcwall::deck
