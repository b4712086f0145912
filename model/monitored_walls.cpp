#include <algorithm>
#include <utility>

#include "model/build_contact.hpp"
#include "model/compliant_contact.hpp"
#include "model/friction_at_wall.hpp"
#include "model/monitored.hpp"
#include "model/wall_force.hpp"

namespace arcwall {

const CompliantContact* Measured::elastic_friction() const {
  const auto* const compliant = dynamic_cast<const CompliantContact*>(contacts);
  return compliant != nullptr && compliant->elastic_friction() != nullptr ? compliant : nullptr;
}

namespace {

// The resultant force of a wall, on a member or on its end where these are named; null where the deck has other
// problems, so that nothing is traced.
std::shared_ptr<const Observable> wall_force(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                             std::string member, std::optional<double> end) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  if (from.contacts == nullptr) return std::make_shared<ParameterValue>();
  if (deck::is_of_friction(monitor.component)) {
    const auto* const friction = dynamic_cast<const FrictionalContact*>(from.contacts);
    const FrictionAtWall::What what = monitor.component == deck::Component::friction_force ? FrictionAtWall::What::force
                                      : monitor.component == deck::Component::slip         ? FrictionAtWall::What::slip
                                                                                   : FrictionAtWall::What::greatest_use;
    if (const auto* const compliant = from.elastic_friction())
      return std::make_shared<ElasticFrictionAtWall>(
          *compliant, ContactsOfWall{.wall = wall.name, .member = std::move(member), .fraction = end}, what);
    if (friction == nullptr) return std::make_shared<ParameterValue>();
    return std::make_shared<FrictionAtWall>(
        *from.contacts, *friction, ContactsOfWall{.wall = wall.name, .member = std::move(member), .fraction = end},
        what);
  }
  const WallForce::What what = monitor.component == deck::Component::force_x   ? WallForce::What::x
                               : monitor.component == deck::Component::force_z ? WallForce::What::z
                                                                               : WallForce::What::moment;
  ContactsOfWall of{.wall = wall.name, .member = std::move(member), .fraction = end};
  return std::make_shared<WallForce>(*from.contacts, std::move(of), what, motion_of(wall).about);
}

}  // namespace

std::shared_ptr<const Observable> contact_edge(const Measured& from, const deck::Monitor& monitor,
                                               ContactEdge::What what) {
  if (from.contacts == nullptr) return std::make_shared<ParameterValue>();  // as above
  const bool first = monitor.component == deck::Component::contact_start;
  return std::make_shared<ContactEdge>(*from.contacts, from.body,
                                       ContactsOfWall{.wall = monitor.wall, .member = monitor.member},
                                       from.structure.members()[from.member_index(monitor.member)].length,
                                       first ? ContactEdge::Which::first : ContactEdge::Which::last, what);
}

std::shared_ptr<const Observable> shown_on_wall(const deck::Deck& deck, const Measured& from,
                                                const deck::Monitor& monitor, DeckProblems& problems) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  if (monitor.member.empty() || concerns(wall, monitor.member))
    return is_contact_edge(monitor.component) ? contact_edge(from, monitor, ContactEdge::What::arc_length)
                                              : wall_force(deck, from, monitor, monitor.member, std::nullopt);
  problems.add(monitor.position, "monitor.member",
               "wall \"" + wall.name + "\" does not stand in the way of \"" + monitor.member + "\"",
               "add the member to `members` of the wall, or name a member that is there");
  return nullptr;
}

std::shared_ptr<const Observable> shown_between(const deck::Deck& deck, const Measured& from,
                                                const deck::Monitor& monitor, DeckProblems& problems) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  const std::vector<EndOfMember> at = ends_of(from, monitor.at);
  const auto concerned = [&](const EndOfMember& end) { return concerns(wall, end.mesh->name); };
  const auto end = std::find_if(at.begin(), at.end(), concerned);
  if (end == at.end()) {
    problems.add(monitor.position, "monitor.wall",
                 "wall \"" + wall.name + "\" does not stand in the way of \"" + to_text(monitor.at) + "\"",
                 "add the member to `members` of the wall, or name a place of a member that is there");
    return nullptr;
  }
  const bool is_of_place = monitor.component == deck::Component::gap || monitor.component == deck::Component::slip;
  if (!is_of_place && deck.contact.is_compliant()) {
    problems.add(monitor.position, "monitor.at",
                 "a compliant wall presses along members: it has no force at \"" + to_text(monitor.at) + "\"",
                 "give `member` instead of `at`");
    return nullptr;
  }
  if (monitor.component != deck::Component::gap)
    return wall_force(deck, from, monitor, end->mesh->name, end->fraction());
  return from.body.gap(from.member_index(end->mesh->name), end->position,
                       faced_obstacle(wall, *end->mesh, end->fraction()));
}

std::shared_ptr<const Observable> friction_power(const Measured& from, const deck::Monitor& monitor) {
  if (const auto* const compliant = from.elastic_friction())
    return std::make_shared<ElasticFrictionPower>(*compliant, monitor.wall);
  const auto* const friction = dynamic_cast<const FrictionalContact*>(from.contacts);
  if (friction == nullptr) return std::make_shared<ParameterValue>();  // the deck has other problems
  return std::make_shared<FrictionPower>(*from.contacts, *friction, monitor.wall);
}

}  // namespace arcwall
