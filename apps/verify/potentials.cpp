#include "apps/verify/potentials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "apps/verify/potential_rooms.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

Rates rates_of_supports(const Structure& structure) {
  Rates rates;
  structure.nodal_terms().for_each_moved_support([&](Index dof, double rate) { rates[dof] = rate; });
  return rates;
}

double rate_of(const Rates& rates, Index dof) {
  const auto found = rates.find(dof);
  return found == rates.end() ? 0.0 : found->second;
}

namespace {

// visit(unknown, load, displacement) for each degree of freedom that carries one; the unknown is −1 where a support
// holds it.
template <class Visit>
void for_each_point_load(const Model& model, const State& state, const Visit& visit) {
  const Structure& structure = model.structure();
  std::set<Index> dofs;
  for (Index e = 0; e < structure.element_count(); ++e) {
    const ShiftedIndices of_element = structure.element_dofs(e);
    for (std::size_t i = 0; i < of_element.size(); ++i) dofs.insert(of_element[i]);
  }
  for (const Index dof : dofs) {
    const double load = structure.nodal_terms().load(dof).at(state.lambda);
    if (load == 0.0) continue;
    if (const SlidingStructure* body = model.sliding_structure(); body == nullptr) {
      visit(structure.unknown(dof).value_or(-1), load, structure.value(state, dof));
    } else {
      visit(body->unknown(mesh_of(state), dof).value_or(-1), load,
            body->value(mesh_of(state), mesh_state_of(state), dof));
    }
  }
}

}  // namespace

std::vector<Potential> potentials(const Model& model, const PlainMembers& members, const State& state) {
  std::vector<Potential> all =
      model.sliding() != nullptr ? sliding_potentials(model, members, state) : fixed_potentials(model, members, state);
  add_compliant_walls(model, state, all);
  add_springs(model, state, all);
  add_pressed_ends(model, state, all);
  return all;
}
Index structure_unknowns(const Model& model, const State& state) {
  return model.sliding() != nullptr ? mesh_of(state).unknowns() : model.structure().size({});
}

Vector point_loads(const Model& model, const State& state) {
  Vector loads = Vector::Zero(structure_unknowns(model, state));
  for_each_point_load(model, state, [&](Index i, double load, double) {
    if (i >= 0) loads[i] += load;
  });
  return loads;
}

double work_of_point_loads(const Model& model, const State& state) {
  double work = 0.0;
  for_each_point_load(model, state, [&](Index, double load, double displacement) { work += load * displacement; });
  return work;
}

namespace {

// A place of a member's mesh, middle nodes included.
std::string name_of_node(const Structure& structure, Index node) {
  for (const MemberMesh& mesh : structure.members()) {
    const auto at = [&](const std::vector<Index>& nodes) {
      return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    if (const auto k = at(mesh.nodes); k < mesh.nodes.size()) return mesh.name + ":" + round_trip(mesh.fraction(k));
    if (const auto k = at(mesh.middle_nodes); k < mesh.middle_nodes.size())
      return mesh.name + ":" + round_trip(mesh.fraction(k) + 0.5 / double(mesh.nodes.size() - 1));
  }
  return std::to_string(node);
}

std::string word(Dof dof) {
  switch (dof) {
    case Dof::x:
      return "x";
    case Dof::z:
      return "z";
    case Dof::rotation:
      return "rotation";
    case Dof::thickness:
      return "thickness";
    case Dof::thickness2:
      return "thickness2";
  }
  return {};
}

}  // namespace

std::string name_of_unknown(const Model& model, const State& state, Index unknown) {
  if (model.sliding() == nullptr) {
    const auto [node, dof] = model.structure().meaning(unknown);
    return word(dof) + " at " + name_of_node(model.structure(), node);
  }
  const SlidingMesh& mesh = mesh_of(state);
  for (Index strand = 0; strand < model.sliding_structure()->strands(); ++strand)
    for (Index position = 0; position < mesh.nodes(strand); ++position) {
      const NodeUnknowns unknowns = mesh.node_unknowns(strand, position);
      const auto found = std::find(unknowns.begin(), unknowns.end(), unknown);
      if (found == unknowns.end()) continue;
      const auto [member, fraction] = model.sliding_structure()->label(
          {.strand = strand, .s = mesh.coordinate(strand, position, mesh_state_of(state).s)});
      constexpr std::array<Dof, 3> kinds{Dof::x, Dof::z, Dof::rotation};
      return word(kinds[static_cast<std::size_t>(found - unknowns.begin())]) + " at " + member + ":" +
             round_trip(fraction);
    }
  return std::to_string(unknown);
}

Vector gradient_rate(const Potential& potential) {
  if (potential.rates.size() == 0 || potential.rates.isZero(0.0)) return {};
  return potential.stiffness * potential.rates;
}

}  // namespace arcwall::verify
