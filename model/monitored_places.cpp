#include <algorithm>
#include <array>
#include <utility>

#include "elements/member_point.hpp"
#include "model/monitored.hpp"
#include "model/support_reaction.hpp"

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

std::vector<EndOfMember> ends_at(const Structure& structure, Index joint) {
  std::vector<EndOfMember> ends;
  for (const MemberMesh& mesh : structure.members()) {
    if (mesh.nodes.front() == joint) ends.push_back({.mesh = &mesh, .position = 0});
    if (mesh.nodes.back() == joint) ends.push_back({.mesh = &mesh, .position = mesh.nodes.size() - 1});
  }
  return ends;
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
std::shared_ptr<const Observable> member_force(const Measured& from, const std::vector<EndOfMember>& at,
                                               deck::Component component) {
  const bool bends = component == deck::Component::moment;
  if (at.size() != 1) return nullptr;
  const MemberMesh& mesh = *at.front().mesh;
  const std::size_t position = at.front().position;
  if (bends && !mesh.rotations[position]) return nullptr;
  return from.body.section_force(index_of(mesh, from.structure), at.front().fraction(),
                                 bends ? Body::SectionForce::moment : Body::SectionForce::axial_force);
}

}  // namespace

// Of a place inside a member that member alone.
std::vector<EndOfMember> ends_of(const Measured& from, const deck::Place& place) {
  const Places::Node node = from.places.find(place, from.structure.members());
  if (node.member != nullptr) return {{.mesh = node.member, .position = node.position}};
  return ends_at(from.structure, node.node);
}

std::shared_ptr<const Observable> shown_at(const Measured& from, const deck::Place& place, deck::Component component) {
  const Structure& structure = from.structure;
  const Places::Node node = from.places.find(place, structure.members());
  std::vector<EndOfMember> at = ends_of(from, place);
  // A point's rotation is that which its members share, not that of a hinged end.
  if (const auto shared = from.places.rotations.find(place.name);
      !place.fraction && shared != from.places.rotations.end())
    std::stable_partition(at.begin(), at.end(), [&](const EndOfMember& end) {
      return end.mesh->rotations[end.position] == std::optional(shared->second);
    });
  if (component == deck::Component::axial_force || component == deck::Component::moment)
    return member_force(from, at, component);
  if (const auto dof = reaction_dof(component)) {
    if (*dof != Dof::rotation) return support_reaction(from, structure.dof(node.node, *dof));
    for (const EndOfMember& end : at)
      if (const auto rotation = end.mesh->rotations[end.position]; rotation && structure.is_ever_held(*rotation))
        return support_reaction(from, *rotation);
    return nullptr;
  }
  for (const EndOfMember& end : at)
    if (const auto thickness = end.mesh->section(end.position).thickness)
      if (const auto dof = thickness_dof(*thickness, component)) return from.body.motion(*dof);
  const auto wanted = member_component(component);
  if (!wanted) return nullptr;
  const bool turns = *wanted != Component::x && *wanted != Component::z;
  const bool face = *wanted == Component::face_above_z || *wanted == Component::face_below_z;
  for (const EndOfMember& end : at) {
    const auto rotation = end.mesh->rotations[end.position];
    if ((turns && !rotation) || (face && !end.mesh->height)) continue;
    // Members that meet at an angle agree on the rotation of their joint, not on the slopes of their imperfections.
    if (*wanted == Component::rotation && at.size() > 1) return from.body.motion(*rotation);
    return from.body.motion(index_of(*end.mesh, structure), end.position, *wanted);
  }
  return nullptr;
}

}  // namespace arcwall
