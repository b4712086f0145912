#include "model/element_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/layout.hpp"

namespace arcwall {

namespace {

double angle_of(const Vec2& chord) { return std::atan2(chord.y(), chord.x()); }

// By how much the end of an element at `here` has turned since the body was undeformed, less what its chord has.
double slope(const AxisPlace& here, const AxisPlace& rest, double chord_turned) {
  return std::abs(std::remainder(here.angle - rest.angle - chord_turned, 2.0 * pi));
}

}  // namespace

double greatest_slope(const Model& model, const State& state) {
  const SlidingStructure* const body = model.sliding_structure();
  if (body == nullptr) return 0.0;
  const SlidingMesh& mesh = sliding_layout(state.piece).mesh();
  const MeshState now = mesh_state_of(state);
  double greatest = 0.0;
  for (Index strand = 0; strand < body->strands(); ++strand)
    for (Index position = 1; position < mesh.nodes(strand); ++position) {
      const auto rest = [&](Index at) {
        return body->undeformed({.strand = strand, .s = mesh.coordinate(strand, at, now.s)}, true);
      };
      const AxisPlace a = mesh.node(strand, position - 1, now), b = mesh.node(strand, position, now);
      const AxisPlace rest_a = rest(position - 1), rest_b = rest(position);
      const double turned = angle_of(b.position - a.position) - angle_of(rest_b.position - rest_a.position);
      greatest = std::max({greatest, slope(a, rest_a, turned), slope(b, rest_b, turned)});
    }
  return greatest;
}

}  // namespace arcwall
