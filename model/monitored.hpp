#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elements/kinked_springs.hpp"
#include "model/build_structure.hpp"
#include "model/contact_edge.hpp"
#include "model/member_extreme.hpp"
#include "model/model.hpp"

namespace arcwall {

class CompliantContact;

/// What monitors are read off.
struct Measured {
  const Structure& structure;  ///< of the deck's mesh
  const Body& body;
  const Places& places;
  const ContactQuery* contacts = nullptr;  ///< of the system's states; null where there are none
  bool walls_are_rigid = false;            ///< their forces are unknowns, and not among those of the structure
  const KinkedSprings* kinked = nullptr;   ///< the same where laws have kinks; else null

  std::size_t member_index(const std::string& name) const { return static_cast<std::size_t>(places.members.at(name)); }

  /// Compliant walls with friction; null where there are none.
  const CompliantContact* elastic_friction() const;
};

// --- places ---------------------------------------------------------------------------------------------------------

/// What a component of a place is read from; null if the place has no such component.
std::shared_ptr<const Observable> shown_at(const Measured& from, const deck::Place& place, deck::Component component);

/// A node of a member where a place is. At a joint each member that ends there has one.
struct EndOfMember {
  const MemberMesh* mesh = nullptr;
  std::size_t position = 0;

  double fraction() const { return mesh->fraction(position); }
};
std::vector<EndOfMember> ends_of(const Measured& from, const deck::Place& place);

// --- walls ----------------------------------------------------------------------------------------------------------

/// What a monitor shows of a wall, alone or on a member. Adds a problem where the wall is not in the member's way.
std::shared_ptr<const Observable> shown_on_wall(const deck::Deck& deck, const Measured& from,
                                                const deck::Monitor& monitor, DeckProblems& problems);

/// The gap between a place and a wall, or what the wall exerts there. Adds a problem where it is not in the way.
std::shared_ptr<const Observable> shown_between(const deck::Deck& deck, const Measured& from,
                                                const deck::Monitor& monitor, DeckProblems& problems);

/// Where contact of a wall with a member begins or ends.
std::shared_ptr<const Observable> contact_edge(const Measured& from, const deck::Monitor& monitor,
                                               ContactEdge::What what);

/// The power that friction of a wall, or of all, dissipates.
std::shared_ptr<const Observable> friction_power(const Measured& from, const deck::Monitor& monitor);

// --- members --------------------------------------------------------------------------------------------------------

/// A member and the quantities of which a monitor shows the greatest, the least or the mean.
struct AlongMember {
  std::string member{};
  SectionQuantities of{};
};
std::vector<AlongMember> along_members(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor);

/// Its value, its place, a fraction of its member, or that member's number. Null of load increments.
enum class OfGreatest { value, place, member };
std::shared_ptr<const Observable> greatest(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                           OfGreatest what);

/// Null of load increments.
std::shared_ptr<const Observable> mean(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor);

// --- springs --------------------------------------------------------------------------------------------------------

/// The force or moment of a spring; null if it has none in that direction.
std::shared_ptr<const Observable> spring_force(const deck::Deck& deck, const Measured& from,
                                               const deck::Monitor& monitor);

}  // namespace arcwall
