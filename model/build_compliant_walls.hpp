#pragma once

#include <functional>
#include <vector>

#include "model/build_contact.hpp"
#include "model/compliant_contact.hpp"

namespace arcwall {

/// A compliant wall in the way of a member: as the structure has it, and as contact tells it.
struct CompliantWallOfMember {
  CompliantContact::Wall contact{};
  CompliantWall pressure{};
};

/// Those of a deck, in the order in which the structure has them; none if its walls are not compliant. `mesh_of`: of
/// each member.
std::vector<CompliantWallOfMember> compliant_walls(const deck::Deck& deck,
                                                   const std::function<const MemberMesh&(Index)>& mesh_of);

/// Adds a problem for what does not go with compliant walls, and for each that a member penetrates at the start.
void check_compliant_walls(const deck::Deck& deck, const Structure& structure, DeckProblems& problems);

}  // namespace arcwall
