#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "contact/moving_obstacle.hpp"
#include "contact/multiplier_contact.hpp"
#include "contact/outline.hpp"
#include "contact/sliding_contact.hpp"
#include "elements/sliding_structure.hpp"
#include "model/build_structure.hpp"
#include "model/place_gap.hpp"

namespace arcwall {

/// How λ moves a wall.
RigidMotion motion_of(const deck::Wall& wall);

/// The walls of which a wall with sharp hollow corners is made: what is in such a corner touches two of them. Itself
/// where it has none. All have its name.
std::vector<deck::Wall> parts_of(const deck::Wall& wall);
std::vector<deck::Wall> walls_in_parts(const deck::Deck& deck);

/// What stands in the way where the deck has a wall: to a profile that of the body's faces, to an outline that of an
/// axis from which the body's outside is this far.
std::shared_ptr<const Obstacle> obstacle_of(const deck::Wall& wall, double half_height = 0.0);

/// The outline of a wall that has one.
std::unique_ptr<Outline> outline_of(const deck::Wall& wall);

/// How far the axis of a body of this height stays off an outline; profiles are touched by the faces themselves.
double kept_off(const deck::Wall& wall, double height);

/// What stands in the way of a member where the deck has a wall, and the faces that it is touched by.
FacedObstacle faced_obstacle(const deck::Wall& wall, const MemberMesh& mesh, double fraction);

/// Holds the rotations of straight members that lie on a line between two rigid walls which leave no clearance, where
/// sections turn with the axis: between its nodes it is on that line, too.
void hold_between_walls(const deck::Deck& deck, StructureBuilder& builder);

/// Where walls without clearance hold members at points that slide through.
using PinchedPlaces = std::vector<SlidingContact::PinchedPlace>;

/// Whether an outline can be touched by a member of some height at all; adds a problem if not. `known`: where knife
/// edges hold members; `unit`: the deck's unit of length.
bool can_touch(const deck::Wall& wall, const MemberMesh& mesh, const PinchedPlaces& known, double unit,
               DeckProblems& problems);

PinchedPlaces pinched_places(const deck::Deck& deck, const SlidingStructure& structure);

/// Every node of a wall's members against the wall: on the face that looks at it, or on the axis. Points that supports
/// hold stand last. `at_rest` gets a problem for each wall that a member penetrates at the start, and for walls without
/// clearance on both sides of a node that it is not known how to hold; `known`: where it is known without nodes.
/// `problems`: for each node that λ moves along a wall with friction.
std::vector<Candidate> contact_candidates(const deck::Deck& deck, const Structure& structure,
                                          const PinchedPlaces& known, DeckProblems& at_rest, DeckProblems& problems);

/// Of each candidate 1 if it is at a node and stands for contact along a member, 0 if nothing but this point of the
/// body can touch there: a member's free end, a joint of bars.
std::vector<std::uint8_t> stand_for_members(const Structure& structure, const std::vector<Candidate>& candidates);

/// The deck with its walls as they are while what is constant grows with λ from 0 to 1: at rest, but for those with an
/// interference, which come to their places. Such a wall comes along its normal where the stress-free structure is
/// deepest in it; one that is_enclosed() comes along all its normals.
deck::Deck with_walls_of_ramp(deck::Deck deck, const Structure& structure);

/// Whether the same walls concern two members.
bool same_walls(const deck::Deck& deck, const std::string& a, const std::string& b);

/// The walls for contact points that slide.
std::vector<SlidingObstacle> sliding_obstacles(const deck::Deck& deck, const SlidingStructure& structure);

}  // namespace arcwall
