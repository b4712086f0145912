#include "answers/element_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/layout.hpp"

namespace arcwall {

namespace {

double angle_of(const Vec2& chord) { return std::atan2(chord.y(), chord.x()); }

// An end of an element: where it is, and by how much its section has turned since the body was undeformed.
struct End {
  Vec2 rest = Vec2::Zero(), now = Vec2::Zero();
  double turned = 0.0;
};

// By how much either end has turned, less what the chord has.
double slope_of(const End& a, const End& b) {
  const double chord_turned = angle_of(b.now - a.now) - angle_of(b.rest - a.rest);
  const auto slope = [&](const End& end) { return std::abs(std::remainder(end.turned - chord_turned, 2.0 * pi)); };
  return std::max(slope(a), slope(b));
}

double greatest_on(const SlidingStructure& body, const State& state) {
  const SlidingMesh& mesh = sliding_layout(state.active_set).mesh();
  const MeshState now = mesh_state_of(state);
  const auto end_at = [&](Index strand, Index position) {
    const AxisPlace rest = body.undeformed({.strand = strand, .s = mesh.coordinate(strand, position, now.s)}, true);
    const AxisPlace here = mesh.node(strand, position, now);
    return End{.rest = rest.position, .now = here.position, .turned = here.angle - rest.angle};
  };
  double greatest = 0.0;
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (Index position = 1; position < mesh.nodes(strand); ++position)
      greatest = std::max(greatest, slope_of(end_at(strand, position - 1), end_at(strand, position)));
  return greatest;
}

double greatest_on(const Structure& structure, const State& state) {
  double greatest = 0.0;
  for (const MemberMesh& member : structure.members()) {
    if (!member.rotations.front()) continue;  // a bar
    const auto end_at = [&](std::size_t k) {
      return End{.rest = structure.position(member.nodes[k]),
                 .now = structure.current(state, member.nodes[k]),
                 .turned = structure.value(state, *member.rotations[k])};
    };
    for (std::size_t k = 1; k < member.nodes.size(); ++k)
      greatest = std::max(greatest, slope_of(end_at(k - 1), end_at(k)));
  }
  return greatest;
}

}  // namespace

double greatest_slope(const Model& model, const State& state) {
  const SlidingStructure* const body = model.sliding_structure();
  return body != nullptr ? greatest_on(*body, state) : greatest_on(model.structure(), state);
}

}  // namespace arcwall
