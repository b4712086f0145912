// Segments of a mesh that slides which lie straight, of whatever length, none included.
#include <algorithm>

#include "core/unit_tangent.hpp"
#include "elements/sliding_mesh.hpp"

namespace arcwall {

const SlidingStructureMesh::Straight* SlidingStructureMesh::straight_at(Index strand, Index position) const {
  const auto found = std::find_if(straights_.begin(), straights_.end(), [&](const Straight& straight) {
    return straight.strand == strand && straight.position == position;
  });
  return found == straights_.end() ? nullptr : &*found;
}

std::optional<Index> SlidingStructureMesh::axial_force(Index strand, Index position) const {
  const Straight* const straight = straight_at(strand, position);
  return straight != nullptr ? std::optional(straight->force) : std::nullopt;
}

// With d = S2 − S1, the direction t half-way between those of the ends, ℓ = t·(r2 − r1) and M₀ = EI κ₀:
//
//   Π = N (ℓ − (1 + e) d) − ½ N² d/EA + ½ γ c² − M₀ (θ2 − θ1) + ½ M₀² d/EI
//   c = ℓ − (1 + e + N/EA) d,     ∂Π/∂N = a c,     a = 1 − γ d/EA
//
// N alone is regular at d = 0, where a bar of stiffness EA/d is not. γ = EA/L adds nothing where c = 0: with it a part
// that nothing but N holds along the axis is no mechanism before N is eliminated, and a > 0.
SlidingStructureMesh::Response SlidingStructureMesh::respond_straight(const Straight& straight, const MeshState& now,
                                                                      AxialResponse* axial) const {
  const auto& [strand, position, force] = straight;
  const SlidingStructure::Run& described = structure_.at(strand);
  const Ends at = ends(strand, position, now);
  const double S1 = coordinate(strand, position, now.s), S2 = coordinate(strand, position + 1, now.s);
  const double d = S2 - S1, N = now.x[force];
  const MaterialPoint middle{.strand = strand, .s = 0.5 * (S1 + S2)};
  const auto [EA, EI] = structure_.stiffness(middle);
  const double M = EI * structure_.natural_curvature(middle, now.lambda);
  const double stretch = 1.0 + described.thermal.strain.at(now.lambda) + N / EA;
  const double gamma = EA / described.length, a = 1.0 - gamma * d / EA;
  const Vec2 t = unit_tangent(0.5 * (at.angle1 + at.angle2)), n = perp(t), chord = at.second - at.first;
  const double c = t.dot(chord) - stretch * d, turned = 0.5 * n.dot(chord);
  const auto by_ends = [](const Vec2& first, double angle1, const Vec2& second, double angle2) {
    Six out;
    out << first, angle1, second, angle2;
    return out;
  };
  const Six g = by_ends(-t, turned, t, turned), moment = by_ends(Vec2::Zero(), 1.0, Vec2::Zero(), -1.0);
  const double pull = N + gamma * c;

  Response out;
  out.energy = N * (c + 0.5 * N * d / EA) + 0.5 * gamma * c * c - M * (at.angle2 - at.angle1) + 0.5 * M * M * d / EI;
  out.force = pull * g + M * moment;
  out.stiffness = gamma * g * g.transpose();
  const Six of_turn = 0.5 * by_ends(-n, 0.0, n, 0.0);
  for (const Index angle : {2, 5}) {
    out.stiffness.col(angle) += pull * of_turn;
    out.stiffness.row(angle) += pull * of_turn.transpose();
    for (const Index other : {2, 5}) out.stiffness(angle, other) -= 0.25 * pull * t.dot(chord);
  }
  out.force_rate = {Six(gamma * stretch * g), Six(-gamma * stretch * g)};
  const double heat = described.thermal.strain.proportional;
  out.force_lambda = -gamma * heat * d * g + EI * described.thermal.curvature.proportional * moment;
  if (axial != nullptr) {
    axial->value = a * c;
    axial->by_itself = -a * d / EA;
    axial->by_lambda = -a * heat * d;
    axial->by_ends = a * g;
    axial->rate[1] = -a * stretch - gamma / EA * c;
    axial->rate[0] = -axial->rate[1];
  }
  if (described.loads.empty() && !described.has_foundation() && described.pressure.is_zero()) return out;
  const StretchReference reference = this->reference(strand, position, now);
  if (!described.loads.empty()) add_loads(strand, position, reference, at, now, out);
  if (described.has_foundation())
    add_foundation(described, reference, structure_.undeformed({.strand = strand, .s = S1}, true).position, at, out);
  if (!described.pressure.is_zero()) add_pressure(strand, position, at, now, out);
  return out;
}

void SlidingStructureMesh::add_straight(const Straight& straight, const MeshState& now, Eigen::Ref<Vector> F,
                                        Linearization* out) const {
  const auto& [strand, position, force] = straight;
  AxialResponse axial;
  const Response response = respond_straight(straight, now, &axial);
  F[force] += axial.value;
  if (out == nullptr) return add_forces(strand, position, response, F);
  add(strand, position, response, &axial, *out);
  out->F_lambda[force] += axial.by_lambda;
  for (std::size_t end = 0; end < 2; ++end) {
    const Coordinate& place = mesh_of(strand).nodes[static_cast<std::size_t>(position) + end];
    for (std::size_t j = 0; j < 2; ++j)
      if (place.breakpoint[j] != held) out->B(force, place.breakpoint[j]) += place.weight[j] * axial.rate[end];
  }
}

}  // namespace arcwall
