#pragma once

#include <string>
#include <vector>

#include "contact/candidate.hpp"
#include "contact/sliding_contact.hpp"
#include "elements/structure.hpp"
#include "model/build_structure.hpp"
#include "model/deck/deck.hpp"

namespace arcwall {

/// Whether a deck's path is followed in increments, which update the mesh.
bool wants_increments(const deck::Deck& deck);

/// Whether it is and can be. Adds why it cannot to `problems`, and what of the deck increments do not know.
bool takes_increments(const deck::Deck& deck, const Structure& structure, DeckProblems& problems);

/// Whether contact points of a deck may slide along its members as far as these are concerned.
bool may_slide(const deck::Deck& deck, const StructureBuilder& builder);

/// Whether they do, which members that walls hold from both sides do not allow either. Adds to `problems` where the
/// deck asks for what is not possible.
bool slides(const deck::Deck& deck, const StructureBuilder& builder, const std::vector<Candidate>& candidates,
            DeckProblems& problems);

/// What to tell of walls with an interference that the undeformed structure does not reach into, at nodes or between
/// them. `sliding`: contact at moving points; else null.
std::vector<std::string> interference_warnings(const deck::Deck& deck, const MultiplierContact& at_nodes,
                                               const SlidingContact* sliding);

/// Adds what a deck with friction asks for that friction does not know. `sliding`: null for contact at nodes.
void check_friction(const deck::Deck& deck, const Structure& structure, const std::vector<Candidate>& candidates,
                    const SlidingStructure* sliding, DeckProblems& problems);

/// Adds members that lie on walls with friction at the start. `toward`: where λ goes from there.
void check_friction_at_start(const SlidingContact& contact, double toward, DeckProblems& problems);

/// Whether λ moves a structure.
bool moves_something(const Structure& structure);

/// Adds that nothing moves in a stage; `all_is_held`: since nothing is left that could.
void report_nothing_moves(const deck::Deck& deck, std::size_t stage, bool all_is_held, DeckProblems& problems);

/// Adds walls with sharp hollow corners, in which a node that is a contact would touch two lines at once.
void check_hollow_corners(const deck::Deck& deck, DeckProblems& problems);

/// Adds what is inside a wall at the start though none of its nodes is: a wall may be narrower than an element.
void check_between_nodes(const deck::Deck& deck, const SlidingContact& contact, DeckProblems& problems);

/// Adds watched monitors that are greatest along a member: they turn in a kink where their place jumps, and an event
/// there would have no derivatives.
void check_watched(const deck::Deck& deck, DeckProblems& problems);

/// Adds what is wrong with the deck's `path.sensitivity`.
void check_sensitivity(const deck::Deck& deck, DeckProblems& problems);

/// Adds what of `curve.parameter` and `curve.worst` names no number.
void check_curve(const deck::Deck& deck, DeckProblems& problems);

/// How a path begins to leave the bounds of λ where it starts; empty if it does not.
std::string start_outside_bounds(const deck::Path& path);

/// Says how far a law whose interpolation was not asked for is from straight pieces; empty where it was.
std::string smoothed_law(const deck::Spring& spring, double unit);

/// Says that the law of a foundation holds nothing at rest, in a deck whose supports leave rigid motions free; empty if
/// it does.
std::string flat_law(const deck::Spring& spring, const deck::Units& units);

}  // namespace arcwall
