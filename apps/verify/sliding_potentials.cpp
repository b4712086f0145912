#include <memory>

#include "apps/verify/moved_unknowns.hpp"
#include "apps/verify/potential_rooms.hpp"

namespace arcwall::verify {

namespace {

// What all elements of a state share.
struct SlidingElements {
  const SlidingMesh& mesh;
  Vector s{};  // of the breakpoints
  double lambda = 0.0;
  MovedUnknowns x;
};

Potential sliding_potential(const std::shared_ptr<const SlidingElements>& of, Index strand, Index position,
                            double bends_over) {
  const auto& [mesh, s, lambda, x] = *of;
  const NodeUnknowns first = mesh.node_unknowns(strand, position), second = mesh.node_unknowns(strand, position + 1);
  const double length = mesh.coordinate(strand, position + 1, s) - mesh.coordinate(strand, position, s);
  const double part = ElementSize{.length = length, .bends_over = bends_over}.part();
  Potential potential{.at = Vector::Zero(6), .steps = Vector(6)};
  for (const NodeUnknowns& node : {first, second})
    for (const Index unknown : node) potential.unknowns.push_back(unknown);
  for (std::size_t i = 0; i < 6; ++i) {
    const Index unknown = potential.unknowns[i];
    if (unknown >= 0) potential.at[static_cast<Index>(i)] = x.value(unknown);
    potential.steps[static_cast<Index>(i)] = part * step_of(kind_of(i, 3), length);
  }
  potential.energy = [of, strand, position, unknowns = potential.unknowns](const Vector& u) {
    return of->x.with(unknowns, u, [&](const Vector& moved) {
      return of->mesh.element_energy(strand, position, {moved, of->s, of->lambda});
    });
  };
  potential.gradient = [of, strand, position, unknowns = potential.unknowns](const Vector& u) {
    return of->x.with(unknowns, u, [&](const Vector& moved) {
      const SlidingMesh::EndForces ends = of->mesh.end_forces(strand, position, {moved, of->s, of->lambda});
      Vector gradient(6);
      gradient << ends[0], ends[1];
      return gradient;
    });
  };
  limit_steps(length, 3, potential);
  return potential;
}

}  // namespace

std::vector<Potential> sliding_potentials(const Model& model, const State& state) {
  std::vector<Potential> all;
  const SlidingMesh& mesh = mesh_of(state);
  const auto shared = std::make_shared<const SlidingElements>(
      SlidingElements{.mesh = mesh,
                      .s = mesh_state_of(state).s,
                      .lambda = state.lambda,
                      .x = MovedUnknowns(Vector(state.x.head(mesh.unknowns())))});
  const SlidingStructure& body = *model.sliding_structure();
  for (Index strand = 0; strand < body.strands(); ++strand)
    for (Index position = 0; position + 1 < mesh.nodes(strand); ++position) {
      const double middle =
          0.5 * (mesh.coordinate(strand, position, shared->s) + mesh.coordinate(strand, position + 1, shared->s));
      const std::string member = body.label({.strand = strand, .s = middle}).first;
      all.push_back(sliding_potential(shared, strand, position, narrowest_piece(model.deck(), member)));
    }
  return all;
}

}  // namespace arcwall::verify
