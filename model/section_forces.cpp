#include "model/section_forces.hpp"

#include <tuple>

namespace arcwall {

namespace {

double mean_of(double a, double b) { return 0.5 * (a + b); }

// A node of an element, now or stress-free.
struct ElementNode {
  Vec2 position = Vec2::Zero();
  double angle = 0.0;  // of the section's normal
};

bool flexible_in_shear(Theory theory) {
  switch (theory) {
    case Theory::reissner:
    case Theory::essenburg:
      return true;
    case Theory::euler_bernoulli:
    case Theory::elastica:
    case Theory::truss:
      return false;
  }
  return false;
}

// The axis between two nodes, and its angle against the sections: shear is constant between them. A bar is straight.
std::pair<AxisCurve, double> axis_between(const ElementNode& a, const ElementNode& b, Theory theory) {
  const double angle = mean_of(a.angle, b.angle), chord = angle_near(b.position - a.position, angle);
  if (theory == Theory::truss) return {{a.position, b.position, chord, chord}, 0.0};
  const double shear = flexible_in_shear(theory) ? chord - angle : 0.0;
  return {{a.position, b.position, a.angle + shear, b.angle + shear}, shear};
}

// What the nodes exert on an element, per local unknown. Loads along a bar act at its ends.
Vector element_forces(const Structure& structure, Index e, const State& state, bool loads) {
  const auto dofs = structure.element_dofs(e);
  Vector u(static_cast<Index>(dofs.size())), f(u.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) u[static_cast<Index>(i)] = structure.value(state, dofs[i]);
  structure.element(e).evaluate_at(u.data(), state.lambda, f.data(), nullptr, nullptr);
  if (!loads) return f;
  Vector part(u.size());
  for (const std::uint32_t i : structure.loads_of_element(e)) {
    if (!structure.element_loads()[i].acts_on(state)) continue;
    structure.element_loads()[i].potential->evaluate_at(u.data(), state.lambda, part.data(), nullptr, nullptr);
    structure.element_loads()[i].potential->complete_end_forces(u.data(), state.lambda, part.data());
    f += part;
  }
  return f;
}

// The nodes of element k of a member in order, its middle node included.
struct ElementNodes {
  std::vector<ElementNode> now{}, rest{};
};

ElementNodes element_nodes(const Structure& structure, const MemberMesh& mesh, std::size_t k, const State& state) {
  ElementNodes nodes;
  const auto add = [&](Index node, std::optional<Index> rotation, double rest_angle) {
    nodes.rest.push_back({.position = structure.position(node), .angle = rest_angle});
    nodes.now.push_back({.position = structure.current(state, node),
                         .angle = rest_angle + (rotation ? structure.value(state, *rotation) : 0.0)});
  };
  add(mesh.nodes[k], mesh.rotations[k], mesh.shape[k].angle);
  if (!mesh.middle_nodes.empty())
    add(mesh.middle_nodes[k], mesh.middle_rotations[k], mean_of(mesh.shape[k].angle, mesh.shape[k + 1].angle));
  add(mesh.nodes[k + 1], mesh.rotations[k + 1], mesh.shape[k + 1].angle);
  return nodes;
}

Index first_element(const Structure& structure, std::size_t member) {
  Index e = 0;
  for (std::size_t m = 0; m < member; ++m) e += static_cast<Index>(structure.members()[m].nodes.size()) - 1;
  return e;
}

}  // namespace

// Sums of nodal forces balance the load along the element, q h = −Σ f, which is spread evenly over it.
void add_stretches(const TiedMember& member, int k, const State& state, std::vector<MemberStretch>& to) {
  const Structure& structure = member.structure;
  const MemberMesh& mesh = structure.members()[member.member];
  const Theory theory = member.theory;
  const ElementNodes nodes = element_nodes(structure, mesh, static_cast<std::size_t>(k), state);
  const Index e = first_element(structure, member.member) + k;
  const Vector f = element_forces(structure, e, state, theory != Theory::truss);
  const std::size_t stretches = nodes.now.size() - 1;
  const auto stride = f.size() / static_cast<Index>(nodes.now.size());
  Vec2 load = Vec2::Zero();
  for (std::size_t a = 0; a <= stretches; ++a) load -= f.segment<2>(stride * static_cast<Index>(a));
  const auto moment = [&](std::size_t a) { return stride > 2 ? f[stride * static_cast<Index>(a) + 2] : 0.0; };

  Resultant carried{};
  for (std::size_t a = 0; a < stretches; ++a) {
    carried.force -= f.segment<2>(stride * static_cast<Index>(a));
    carried.moment -= moment(a);
    const double part = 1.0 / double(stretches), first = double(k) + part * double(a);
    MemberStretch stretch{.from = first / double(mesh.nodes.size() - 1),
                          .to = (first + part) / double(mesh.nodes.size() - 1),
                          .first = carried};
    std::tie(stretch.now, stretch.shear) = axis_between(nodes.now[a], nodes.now[a + 1], theory);
    std::tie(stretch.rest, stretch.rest_shear) = axis_between(nodes.rest[a], nodes.rest[a + 1], theory);
    stretch.second.force = carried.force - part * load;
    stretch.second.moment = moment(stretches);
    if (a + 1 < stretches) stretch.second.moment = stretch.balanced_moment(1.0);
    carried = stretch.second;
    to.push_back(stretch);
  }
}

void add_sliding_stretches(const SlidingStructure& body, Index strand, Index position, const State& state,
                           std::vector<MemberStretch>& to) {
  const SlidingMesh& mesh = mesh_of(state);
  const MeshState now = mesh_state_of(state);
  const double S1 = mesh.coordinate(strand, position, now.s), S2 = mesh.coordinate(strand, position + 1, now.s);
  const AxisPlace a = mesh.node(strand, position, now), b = mesh.node(strand, position + 1, now);
  const AxisPlace a0 = body.undeformed({.strand = strand, .s = S1}, true),
                  b0 = body.undeformed({.strand = strand, .s = S2}, true);
  SlidingMesh::EndForces ends = mesh.end_forces(strand, position, now);
  std::vector<PointLoadInside> loads;
  for (const SlidingMesh::PointLoad& load : mesh.point_loads_in(strand, position, now)) {
    if (!load.on_wall) {
      loads.push_back({.at = load.s, .force = load.force});
      continue;
    }
    const double second = (load.s - S1) / (S2 - S1);
    ends[0].head<2>() += (1.0 - second) * load.force;
    ends[1].head<2>() += second * load.force;
  }
  const MemberStretch whole{.from = S1,
                            .to = S2,
                            .now = {a.position, b.position, a.angle, b.angle},
                            .rest = {a0.position, b0.position, a0.angle, b0.angle},
                            .first = {.force = -ends[0].head<2>(), .moment = -ends[0][2]},
                            .second = {.force = ends[1].head<2>(), .moment = ends[1][2]}};
  add_between_loads(whole, loads, to);
}

}  // namespace arcwall
