#include <utility>

#include "model/monitored.hpp"
#include "model/spring_force.hpp"

namespace arcwall {

namespace {

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

}  // namespace

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

}  // namespace arcwall
