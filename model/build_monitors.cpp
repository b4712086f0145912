#include "model/build_monitors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "elements/foundation_law.hpp"
#include "elements/member_point.hpp"
#include "model/build_contact.hpp"
#include "model/contact_edge.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"
#include "model/friction_at_wall.hpp"
#include "model/spring_force.hpp"
#include "model/support_reaction.hpp"
#include "model/wall_force.hpp"

namespace arcwall {

namespace {

using Component = MemberObservable::Component;

// What a component of a deck is called in another room.
template <class Other>
using Counterpart = std::pair<deck::Component, Other>;

template <class Other, std::size_t count>
std::optional<Other> counterpart(const std::array<Counterpart<Other>, count>& known, deck::Component component) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == component; });
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Component> member_component(deck::Component component) {
  constexpr std::array<Counterpart<Component>, 5> known{{{deck::Component::x, Component::x},
                                                         {deck::Component::z, Component::z},
                                                         {deck::Component::rotation, Component::rotation},
                                                         {deck::Component::face_above_z, Component::face_above_z},
                                                         {deck::Component::face_below_z, Component::face_below_z}}};
  return counterpart(known, component);
}

std::optional<Dof> reaction_dof(deck::Component component) {
  constexpr std::array<Counterpart<Dof>, 3> known{{{deck::Component::reaction_x, Dof::x},
                                                   {deck::Component::reaction_z, Dof::z},
                                                   {deck::Component::reaction_moment, Dof::rotation}}};
  return counterpart(known, component);
}

deck::Dimension dimension_of(deck::Component component) {
  switch (component) {
    case deck::Component::rotation:
    case deck::Component::thickness:
    case deck::Component::utilisation:
    case deck::Component::friction_use:
      return deck::unit::none;
    case deck::Component::dissipation:
      return deck::unit::energy;
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::axial_force:
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::friction_force:
      return deck::unit::force;
    case deck::Component::reaction_moment:
    case deck::Component::moment:
    case deck::Component::max_moment:
      return deck::unit::moment;
    case deck::Component::max_stress:
      return deck::unit::stress;
    case deck::Component::greatest_pressure:
    case deck::Component::least_pressure:
    case deck::Component::mean_pressure:
      return deck::unit::line_load;
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::gap:
    case deck::Component::slip:
    case deck::Component::contact_start:
    case deck::Component::contact_end:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
      return deck::unit::length;
    case deck::Component::thickness2:
      return deck::unit::curvature;
  }
  return deck::unit::none;
}

std::shared_ptr<const Observable> in_users_unit(std::shared_ptr<const Observable> quantity, double factor) {
  return factor == 1.0 ? std::move(quantity) : std::make_shared<ScaledObservable>(std::move(quantity), factor);
}

// The coordinate x of a place.
class UsersX final : public Observable {
 public:
  UsersX(std::shared_ptr<const Observable> here, const deck::Frame& frame) : here_(std::move(here)), frame_(frame) {}
  double value(const State& state) const override { return frame_.place({here_->value(state), 0.0}).x(); }
  Row gradient(const State& state) const override {
    Row row = here_->gradient(state);
    row.dx *= frame_.factor();
    row.dlambda *= frame_.factor();
    return row;
  }
  double rate(const State& state, const Direction& direction) const override {
    return frame_.factor() * here_->rate(state, direction);
  }

 private:
  std::shared_ptr<const Observable> here_;
  deck::Frame frame_;
};

// A monitor of the component, without its quantity.
MonitorColumn column_of(std::string name, deck::Component component, const deck::Deck& deck) {
  const deck::Dimension dimension = dimension_of(component);
  std::string unit = unit_text(dimension, deck.units);
  if (component == deck::Component::rotation) unit = "rad";
  if (component == deck::Component::thickness || component == deck::Component::utilisation ||
      component == deck::Component::friction_use)
    unit = "-";
  return {.name = std::move(name),
          .unit = std::move(unit),
          .component = component,
          .factor = deck.frame.factor(dimension.length)};
}

// The member whose end a joint is; where several meet, the first that has what is asked for.
struct End {
  const MemberMesh* mesh = nullptr;
  std::size_t position = 0;
};

std::vector<End> ends_at(const Structure& structure, Index joint) {
  std::vector<End> ends;
  for (const MemberMesh& mesh : structure.members()) {
    if (mesh.nodes.front() == joint) ends.push_back({.mesh = &mesh, .position = 0});
    if (mesh.nodes.back() == joint) ends.push_back({.mesh = &mesh, .position = mesh.nodes.size() - 1});
  }
  return ends;
}

// Of a place inside a member that member alone.
std::vector<End> ends_of(const Measured& from, const deck::Place& place) {
  const Places::Node node = from.places.find(place, from.structure.members());
  if (node.member != nullptr) return {{.mesh = node.member, .position = node.position}};
  return ends_at(from.structure, node.node);
}

std::size_t member_index(const Measured& from, const std::string& name) {
  return static_cast<std::size_t>(from.places.members.at(name));
}

std::size_t index_of(const MemberMesh& mesh, const Structure& structure) {
  return static_cast<std::size_t>(&mesh - structure.members().data());
}

std::optional<Index> thickness_dof(const ThicknessDofs& dofs, deck::Component component) {
  if (component == deck::Component::thickness) return dofs.e;
  if (component == deck::Component::thickness2) return dofs.xi;
  return std::nullopt;
}

// What the member at a place carries there; null where several meet, whose forces differ, or which has no such force.
std::shared_ptr<const Observable> member_force(const Measured& from, const std::vector<End>& at,
                                               deck::Component component) {
  const bool bends = component == deck::Component::moment;
  if (at.size() != 1) return nullptr;
  const MemberMesh& mesh = *at.front().mesh;
  const std::size_t position = at.front().position;
  if (bends && !mesh.rotations[position]) return nullptr;
  return from.body.section_force(index_of(mesh, from.structure), mesh.fraction(position),
                                 bends ? Body::SectionForce::moment : Body::SectionForce::axial_force);
}

}  // namespace

std::shared_ptr<const Observable> shown_at(const Measured& from, const deck::Place& place, deck::Component component) {
  const Structure& structure = from.structure;
  const Places::Node node = from.places.find(place, structure.members());
  std::vector<End> at = ends_of(from, place);
  // A point's rotation is that which its members share, not that of a hinged end.
  if (const auto shared = from.places.rotations.find(place.name);
      !place.fraction && shared != from.places.rotations.end())
    std::stable_partition(at.begin(), at.end(), [&](const End& end) {
      return end.mesh->rotations[end.position] == std::optional(shared->second);
    });
  if (component == deck::Component::axial_force || component == deck::Component::moment)
    return member_force(from, at, component);
  if (const auto dof = reaction_dof(component)) {
    if (*dof != Dof::rotation) return support_reaction(from, structure.dof(node.node, *dof));
    for (const End& end : at)
      if (const auto rotation = end.mesh->rotations[end.position]; rotation && structure.is_ever_held(*rotation))
        return support_reaction(from, *rotation);
    return nullptr;
  }
  for (const End& end : at)
    if (const auto thickness = end.mesh->section(end.position).thickness)
      if (const auto dof = thickness_dof(*thickness, component)) return from.body.motion(*dof);
  const auto wanted = member_component(component);
  if (!wanted) return nullptr;
  const bool turns = *wanted != Component::x && *wanted != Component::z;
  const bool face = *wanted == Component::face_above_z || *wanted == Component::face_below_z;
  for (const End& end : at) {
    const auto rotation = end.mesh->rotations[end.position];
    if ((turns && !rotation) || (face && !end.mesh->height)) continue;
    // Members that meet at an angle agree on the rotation of their joint, not on the slopes of their imperfections.
    if (*wanted == Component::rotation && at.size() > 1) return from.body.motion(*rotation);
    return from.body.motion(index_of(*end.mesh, structure), end.position, *wanted);
  }
  return nullptr;
}

namespace {

// Compliant walls with friction; null where there are none.
const CompliantContact* with_friction(const Measured& from) {
  const auto* const compliant = dynamic_cast<const CompliantContact*>(from.contacts);
  return compliant != nullptr && compliant->elastic_friction() != nullptr ? compliant : nullptr;
}

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
    if (const auto* const compliant = with_friction(from))
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

// Where contact of a wall with a member begins or ends.
std::shared_ptr<const Observable> contact_edge(const Measured& from, const deck::Monitor& monitor,
                                               ContactEdge::What what) {
  if (from.contacts == nullptr) return std::make_shared<ParameterValue>();  // as above
  const bool first = monitor.component == deck::Component::contact_start;
  return std::make_shared<ContactEdge>(*from.contacts, from.body,
                                       ContactsOfWall{.wall = monitor.wall, .member = monitor.member},
                                       from.structure.members()[member_index(from, monitor.member)].length,
                                       first ? ContactEdge::Which::first : ContactEdge::Which::last, what);
}

// A wall that is not in the way of the member exerts nothing on it.
std::shared_ptr<const Observable> on_wall(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                          DeckProblems& problems) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  if (monitor.member.empty() || concerns(wall, monitor.member))
    return is_contact_edge(monitor.component) ? contact_edge(from, monitor, ContactEdge::What::arc_length)
                                              : wall_force(deck, from, monitor, monitor.member, std::nullopt);
  problems.add(monitor.position, "monitor.member",
               "wall \"" + wall.name + "\" does not stand in the way of \"" + monitor.member + "\"",
               "add the member to `members` of the wall, or name a member that is there");
  return nullptr;
}

// --- the gap between a place and a wall -----------------------------------------------------------------------------

// The gap, or the contact force that acts on the place, which is an end of a member.
std::shared_ptr<const Observable> gap(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                      DeckProblems& problems) {
  const deck::Wall& wall = *deck::find(deck.walls, monitor.wall);
  const std::vector<End> at = ends_of(from, monitor.at);
  const auto concerned = [&](const End& end) { return concerns(wall, end.mesh->name); };
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
    return wall_force(deck, from, monitor, end->mesh->name, end->mesh->fraction(end->position));
  return from.body.gap(index_of(*end->mesh, from.structure), end->position,
                       faced_obstacle(wall, *end->mesh, end->mesh->fraction(end->position)));
}

// --- what a member carries ------------------------------------------------------------------------------------------

double moment_at(const MemberStretch& stretch, double xi) { return stretch.moment(xi); }

// What a foundation exerts per length where the axis has moved so far from its stress-free place: with its sign where
// it acts in one direction.
SectionQuantity pressure_of(const deck::Foundation& foundation) {
  FoundationLaw law(Vec2(foundation.x, foundation.z));
  if (foundation.law)
    law.add(foundation.law->direction == Dof::x ? 0 : 1, std::make_shared<const SpringLaw>(foundation.law->law()));
  const auto acts = [&](Dof direction, double stiffness) {
    return stiffness > 0.0 || (foundation.law && foundation.law->direction == direction);
  };
  const bool in_both = acts(Dof::x, foundation.x) && acts(Dof::z, foundation.z);
  return [law = std::move(law), in_both](const MemberStretch& stretch, double xi) {
    const Vec2 force = law.at(stretch.now.position(xi) - stretch.rest.position(xi)).force;
    return in_both ? force.norm() : force.sum();
  };
}

// A member and the quantities of which a monitor shows the greatest.
struct AlongMember {
  std::string member{};
  SectionQuantities of{};
};

// What forces and moments contribute to the stress in an outer fibre.
struct OuterFibre {
  double by_force, by_moment;
};

OuterFibre outer_fibre(const deck::Section& section, double fraction, double unit) {
  const deck::SectionProperties at = properties(section, fraction);
  return {.by_force = 1.0 / (at.A * unit), .by_moment = 0.5 * at.height.value_or(0.0) / (at.I * unit)};
}

// The stresses N/A ± M h/2I in both outer fibres, over what a stress of 1 counts.
AlongMember stresses_in(const deck::Deck& deck, const Measured& from, const deck::Member& member, double unit) {
  const deck::Section& section = *deck::find(deck.sections, member.section);
  const OuterFibre middle = outer_fibre(section, 0.5, unit);
  const double force = from.structure.force_roundoff(), moment = force * from.structure.length_scale();
  const auto* const table = std::get_if<deck::SectionTable>(&section.shape);
  AlongMember along{.member = member.name,
                    .of = {.kinks = table != nullptr ? table->at : std::vector<double>{},
                           .negligible = middle.by_force * force + middle.by_moment * moment}};
  const auto fibre_at = [section, middle, unit, tapers = tapers(section)](const MemberStretch& at, double xi) {
    return tapers ? outer_fibre(section, std::clamp(at.from + xi * (at.to - at.from), 0.0, 1.0), unit) : middle;
  };
  if (member.theory == Theory::truss) {
    along.of.quantities.emplace_back(
        [=](const MemberStretch& at, double xi) { return middle.by_force * at.axial_force(xi); });
    return along;
  }
  for (const double side : {1.0, -1.0})
    along.of.quantities.emplace_back([=](const MemberStretch& at, double xi) {
      const OuterFibre fibre = fibre_at(at, xi);
      return fibre.by_force * at.axial_force(xi) + side * fibre.by_moment * at.moment(xi);
    });
  return along;
}

// Those of a monitor that shows what is greatest, least or the mean.
std::vector<AlongMember> along_members(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor) {
  if (monitor.component == deck::Component::max_moment)
    return {{.member = monitor.member,
             .of = {.quantities = {moment_at},
                    .negligible = from.structure.force_roundoff() * from.structure.length_scale()}}};
  if (is_pressure(monitor.component)) {
    const auto& foundation = std::get<deck::Foundation>(deck::find(deck.springs, monitor.spring)->kind);
    return {{.member = foundation.member, .of = {.quantities = {pressure_of(foundation)}}}};
  }
  std::vector<AlongMember> members;
  for (const deck::Member& member : deck.members) {
    if (!monitor.member.empty() && member.name != monitor.member) continue;
    const deck::Material& material = *deck::find(deck.materials, member.material);
    const bool stress = monitor.component == deck::Component::max_stress;
    members.push_back(stresses_in(deck, from, member, stress ? 1.0 : *material.allowable));
  }
  return members;
}

// Its value, its place, a fraction of its member, or that member's number. Null of load increments.
enum class OfGreatest { value, place, member };

std::shared_ptr<const Observable> greatest(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                           OfGreatest what) {
  const auto which = monitor.component == deck::Component::least_pressure ? MemberExtreme::Which::least
                                                                          : MemberExtreme::Which::greatest;
  std::vector<std::shared_ptr<const Observable>> values, shown;
  for (const AlongMember& along : along_members(deck, from, monitor)) {
    const std::size_t member = member_index(from, along.member);
    const auto elements = from.body.elements(member);
    if (!elements) return nullptr;
    const auto of = [&](MemberExtreme::What part) -> std::shared_ptr<const Observable> {
      return std::make_shared<MemberExtreme>(elements, along.of, which, part);
    };
    values.push_back(of(MemberExtreme::What::value));
    shown.push_back(what == OfGreatest::value   ? values.back()
                    : what == OfGreatest::place ? of(MemberExtreme::What::place)
                                                : std::make_shared<ConstantValue>(double(member)));
  }
  if (values.size() == 1) return shown.front();
  return std::make_shared<GreatestOfMembers>(std::move(values), std::move(shown));
}

// Null of load increments.
std::shared_ptr<const Observable> mean(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor) {
  const AlongMember along = along_members(deck, from, monitor).front();
  auto elements = from.body.elements(member_index(from, along.member));
  return elements ? std::make_shared<MemberMean>(std::move(elements), along.of.quantities.front()) : nullptr;
}

// --- the force of a spring ------------------------------------------------------------------------------------------

// How a place moves in a direction; null if it has no such rotation.
std::shared_ptr<const Observable> motion_in(const Measured& from, const deck::Place& place, Dof direction) {
  const Places::Node at = from.places.find(place, from.structure.members());
  if (direction != Dof::rotation) return from.body.motion(from.structure.dof(at.node, direction));
  if (at.member != nullptr)
    return at.member->rotations[at.position] ? from.body.motion(*at.member->rotations[at.position]) : nullptr;
  const auto rotation = from.places.rotations.find(place.name);
  return rotation == from.places.rotations.end() ? nullptr : from.body.motion(rotation->second);
}

SpringForce::Law law_of(const std::optional<deck::TableLaw>& law, const deck::Stiffness& stiffness, Dof direction) {
  if (law) return std::make_shared<const SpringLaw>(law->law());
  if (direction == Dof::rotation) return stiffness.rotation;
  return direction == Dof::x ? stiffness.x : stiffness.z;
}

// Of a spring at points that has a law, among those of the structure.
std::size_t law_spring_number(const deck::Deck& deck, const deck::Spring& spring) {
  std::size_t before = 0;
  for (const deck::Spring& other : deck.springs) {
    if (&other == &spring) break;
    const auto* ground = std::get_if<deck::GroundSpring>(&other.kind);
    const auto* between = std::get_if<deck::PointToPointSpring>(&other.kind);
    before += (ground != nullptr && ground->law) || (between != nullptr && between->law) ? 1 : 0;
  }
  return before;
}

std::shared_ptr<const Observable> spring_force(const deck::Deck& deck, const Measured& from,
                                               const deck::Monitor& monitor) {
  const deck::Spring& spring = *deck::find(deck.springs, monitor.spring);
  const Dof direction = monitor.component == deck::Component::force_x   ? Dof::x
                        : monitor.component == deck::Component::force_z ? Dof::z
                                                                        : Dof::rotation;
  std::shared_ptr<const Observable> first, second;
  std::optional<SpringForce::Law> law;
  if (const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind)) {
    second = motion_in(from, ground->at, direction);
    law = law_of(ground->law, ground->stiffness, direction);
  } else if (const auto* between = std::get_if<deck::PointToPointSpring>(&spring.kind)) {
    first = motion_in(from, {.name = between->points[0]}, direction);
    second = first ? motion_in(from, {.name = between->points[1]}, direction) : nullptr;
    law = law_of(between->law, between->stiffness, direction);
  }
  if (!second) return nullptr;
  auto force = std::make_shared<SpringForce>(*law, first, second);
  if (from.kinked == nullptr || !std::holds_alternative<std::shared_ptr<const SpringLaw>>(*law)) return force;
  return std::make_shared<KinkedForce>(*from.kinked, std::move(force),
                                       std::vector<KinkedForce::Part>{{law_spring_number(deck, spring), 1.0}});
}

// --- all of them ----------------------------------------------------------------------------------------------------

// What a monitor shows, without its sign; null, with or without a problem of its own, if it has nothing to show.
std::shared_ptr<const Observable> shown_by(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
                                           DeckProblems& problems) {
  if (is_extreme(monitor.component)) return greatest(deck, from, monitor, OfGreatest::value);
  if (monitor.component == deck::Component::mean_pressure) return mean(deck, from, monitor);
  if (monitor.component == deck::Component::dissipation) {
    const auto* const friction = dynamic_cast<const FrictionalContact*>(from.contacts);
    if (const auto* const compliant = with_friction(from))
      return std::make_shared<ElasticFrictionPower>(*compliant, monitor.wall);
    if (friction == nullptr) return std::make_shared<ParameterValue>();  // the deck has other problems
    return std::make_shared<FrictionPower>(*from.contacts, *friction, monitor.wall);
  }
  switch (monitor.of()) {
    case deck::Monitored::wall:
      return on_wall(deck, from, monitor, problems);
    case deck::Monitored::gap:
      return gap(deck, from, monitor, problems);
    case deck::Monitored::spring:
      return spring_force(deck, from, monitor);
    case deck::Monitored::place:
    case deck::Monitored::member:
    case deck::Monitored::structure:
      break;
  }
  const bool is_there = monitor.at.fraction || from.places.joints.contains(monitor.at.name);
  return is_there ? shown_at(from, monitor.at, monitor.component) : nullptr;
}

std::string shown_name(const deck::Monitor& monitor) {
  if (!monitor.member.empty()) return monitor.member;
  if (monitor.of() == deck::Monitored::structure) return "structure";
  return monitor.spring.empty() ? to_text(monitor.at) : monitor.spring;
}

// Where the greatest is: NAME-place, a fraction of the member, and of all members NAME-member, its number.
void add_place(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
               std::vector<MonitorColumn>& columns) {
  const auto add = [&](const char* ending, OfGreatest what) {
    std::string name = monitor.name + ending;
    while (deck::find(deck.monitors, name) != nullptr) name += "-";
    columns.push_back({.name = std::move(name),
                       .unit = "-",
                       .component = monitor.component,
                       .quantity = greatest(deck, from, monitor, what),
                       .is_place = true});
  };
  add("-place", OfGreatest::place);
  if (monitor.of() == deck::Monitored::structure) add("-member", OfGreatest::member);
}

// Where an edge of contact is now: NAME-x.
void add_x(const deck::Deck& deck, const Measured& from, const deck::Monitor& monitor,
           std::vector<MonitorColumn>& columns) {
  std::string name = monitor.name + "-x";
  while (deck::find(deck.monitors, name) != nullptr) name += "-";
  MonitorColumn& column = columns.emplace_back(column_of(std::move(name), monitor.component, deck));
  column.raw = contact_edge(from, monitor, ContactEdge::What::x);
  column.quantity = std::make_shared<UsersX>(column.raw, deck.frame);
}

// A column for each direction that is moved and has no monitor of its reaction: `reaction-x-B`.
void add_reactions_of_movements(const deck::Deck& deck, const Measured& from, std::vector<MonitorColumn>& columns) {
  const auto add = [&](const std::string& point, bool moved, deck::Component component) {
    const auto is_monitored = [&](const deck::Monitor& monitor) {
      return monitor.component == component && !monitor.at.fraction && monitor.at.name == point;
    };
    if (!moved || std::any_of(deck.monitors.begin(), deck.monitors.end(), is_monitored)) return;
    std::string name = text_of(deck::component_words, component) + "-" + point;
    while (deck::find(deck.monitors, name) != nullptr) name += "-";
    const auto quantity = shown_at(from, {.name = point}, component);
    if (deck::find(columns, name) != nullptr || !quantity) return;
    MonitorColumn& column = columns.emplace_back(column_of(std::move(name), component, deck));
    column.raw = quantity;
    column.quantity = in_users_unit(quantity, column.factor);
  };
  for (const deck::Prescribed& moved : deck.prescribed) {
    add(moved.point, moved.x.has_value(), deck::Component::reaction_x);
    add(moved.point, moved.z.has_value(), deck::Component::reaction_z);
    add(moved.point, moved.rotation.has_value(), deck::Component::reaction_moment);
  }
}

}  // namespace

Watch::Kind kind_of(const MonitorColumn& column, const deck::Deck& deck) {
  switch (column.component) {
    case deck::Component::x:
    case deck::Component::z:
    case deck::Component::rotation:
    case deck::Component::face_above_z:
    case deck::Component::face_below_z:
    case deck::Component::slip:
    case deck::Component::gap:
    case deck::Component::contact_start:
    case deck::Component::contact_end:
    case deck::Component::thickness:
    case deck::Component::thickness2:
      return Watch::Kind::motion;
    case deck::Component::force_x:
    case deck::Component::force_z:
    case deck::Component::moment: {
      const deck::Monitor* monitor = deck::find(deck.monitors, column.name);
      const bool of_wall = monitor != nullptr && !monitor->wall.empty();
      return of_wall ? Watch::Kind::contact_force : Watch::Kind::inner_force;
    }
    case deck::Component::friction_force:
    case deck::Component::friction_use:
    case deck::Component::dissipation:
      return Watch::Kind::contact_force;
    case deck::Component::reaction_x:
    case deck::Component::reaction_z:
    case deck::Component::reaction_moment:
    case deck::Component::axial_force:
    case deck::Component::max_moment:
    case deck::Component::max_stress:
    case deck::Component::utilisation:
    case deck::Component::greatest_pressure:
    case deck::Component::least_pressure:
    case deck::Component::mean_pressure:
      return Watch::Kind::inner_force;
  }
  return Watch::Kind::motion;
}

bool is_of_section_forces(deck::Component component) {
  return component == deck::Component::axial_force || component == deck::Component::moment || is_extreme(component) ||
         component == deck::Component::mean_pressure;
}

namespace {

// What nodal forces, which are small differences of great ones, and places, to the corrector's tolerance, leave of
// zero.
double roundoff_of(const deck::Deck& deck, const Measured& from, const MonitorColumn& column) {
  constexpr double of_forces = 10.0, of_places = 1e-12;
  if (deck::is_stress(column.component)) {
    double most = 0.0;
    if (const deck::Monitor* const monitor = deck::find(deck.monitors, column.name))
      for (const AlongMember& along : along_members(deck, from, *monitor))
        most = std::max(most, of_forces * along.of.negligible);
    return most;
  }
  const deck::Dimension unit = dimension_of(column.component);
  return (unit.force != 0 ? of_forces * from.structure.force_roundoff() : of_places) *
         std::pow(from.structure.length_scale(), unit.length);
}

}  // namespace

std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems) {
  std::vector<MonitorColumn> columns;
  for (const deck::Monitor& monitor : deck.monitors) {
    const std::size_t problems_before = problems.count();
    std::shared_ptr<const Observable> quantity = shown_by(deck, from, monitor, problems);
    if (!quantity) {
      if (problems.count() > problems_before) continue;
      if (deck.path.method == deck::PathMethod::incremental && is_of_section_forces(monitor.component)) {
        problems.add(monitor.position, "monitor.component",
                     deck::text_of(deck::component_words, monitor.component) +
                         " is not available with load increments (method \"incremental\")",
                     "remove the monitor, or use another method");
        continue;
      }
      problems.add(monitor.position, "monitor.component",
                   "\"" + shown_name(monitor) + "\" does not have this component",
                   "a rotation needs a beam, a face a section with a height, a reaction a support in its direction, "
                   "reaction-moment "
                   "one of the rotation, thickness the theory \"essenburg\"; axial-force and moment need one member, "
                   "and moment a beam");
      continue;
    }
    MonitorColumn& column = columns.emplace_back(column_of(monitor.name, monitor.component, deck));
    column.raw = quantity;
    column.quantity = in_users_unit(std::move(quantity), monitor.sign * column.factor);
    if (is_extreme(monitor.component)) add_place(deck, from, monitor, columns);
    if (is_contact_edge(monitor.component)) add_x(deck, from, monitor, columns);
  }
  add_reactions_of_movements(deck, from, columns);
  for (MonitorColumn& column : columns) column.roundoff = column.factor * roundoff_of(deck, from, column);
  return columns;
}

}  // namespace arcwall
