#include "apps/verify/potentials.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/verify/differences.hpp"
#include "apps/verify/potential_rooms.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

double step_of(Dof dof, double length) {
  switch (dof) {
    case Dof::x:
    case Dof::z:
      return relative_step * length;
    case Dof::rotation:
    case Dof::thickness:
      return relative_step;
    case Dof::thickness2:
      return relative_step / length;
  }
  return relative_step;
}

Rates rates_of_supports(const Structure& structure) {
  Rates rates;
  structure.nodal_terms().for_each_moved_support([&](Index dof, double rate) { rates[dof] = rate; });
  return rates;
}

double rate_of(const Rates& rates, Index dof) {
  const auto found = rates.find(dof);
  return found == rates.end() ? 0.0 : found->second;
}

Dof kind_of(std::size_t local, std::size_t stride) {
  constexpr Dof kinds[] = {Dof::x, Dof::z, Dof::rotation, Dof::thickness, Dof::thickness2};
  return kinds[local % stride];
}

double narrowest_piece(const deck::Deck& deck, const std::string& member) {
  double narrowest = infinity;
  for (const deck::Spring& spring : deck.springs) {
    const auto* foundation = std::get_if<deck::Foundation>(&spring.kind);
    if (foundation == nullptr || foundation->member != member || !foundation->law) continue;
    const std::vector<double>& u = foundation->law->displacement;
    for (std::size_t i = 1; i < u.size(); ++i) narrowest = std::min(narrowest, u[i] - u[i - 1]);
  }
  return narrowest;
}

std::size_t unknowns_a_node(const MemberMesh& mesh) {
  if (!mesh.thickness.empty()) return 5;
  return mesh.rotations.front() ? 3 : 2;
}

// That is linear in what a step stretches, K_xi, and quadratic in what it turns the chord or an end.
void limit_steps(double length, std::size_t stride, Potential& potential) {
  constexpr double part = 0.01;
  const Vector here = potential.gradient(potential.at);
  Vector along(here.size());  // greatest change of a nodal force with each unknown
  double stretching = 0.0, bending = 0.0;
  const auto is_place = [&](Index i) {
    const Dof kind = kind_of(static_cast<std::size_t>(i), stride);
    return kind == Dof::x || kind == Dof::z;
  };
  for (Index i = 0; i < here.size(); ++i) {
    constexpr double shorter = 1e-4;  // of the steps that are none too long for most
    const double step = shorter * potential.steps[i];
    Vector u = potential.at;
    u[i] += step;
    const Vector change = (potential.gradient(u) - here) / step;
    along[i] = 0.0;
    for (Index j = 0; j < change.size(); ++j)
      if (is_place(j)) along[i] = std::max(along[i], std::abs(change[j]));
    if (is_place(i)) stretching = std::max(stretching, along[i]);
    if (kind_of(static_cast<std::size_t>(i), stride) == Dof::rotation) bending = std::max(bending, std::abs(change[i]));
  }
  if (bending == 0.0 || stretching == 0.0) return;
  const double turning = std::sqrt(part * bending / stretching);  // of a place [length]
  for (Index i = 0; i < here.size(); ++i) {
    const double most = is_place(i) ? turning : turning / length;
    potential.steps[i] = std::min({potential.steps[i], most, part * bending / (length * along[i])});
  }
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

std::vector<Potential> potentials(const Model& model, const State& state) {
  std::vector<Potential> all =
      model.sliding() != nullptr ? sliding_potentials(model, state) : fixed_potentials(model, state);
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
      return word(kind_of(static_cast<std::size_t>(found - unknowns.begin()), 3)) + " at " + member + ":" +
             round_trip(fraction);
    }
  return std::to_string(unknown);
}

Vector forces(const Potential& potential) {
  if (potential.curvature) return potential.gradient(potential.at);
  Vector f = Vector::Zero(potential.at.size());
  for (Index i = 0; i < f.size(); ++i)
    if (potential.unknowns[static_cast<std::size_t>(i)] >= 0)
      f[i] = derivative(
          [&](double step) {
            Vector u = potential.at;
            u[i] += step;
            return potential.energy(u);
          },
          potential.steps[i]);
  return f;
}

Matrix stiffness(const Potential& potential) {
  if (potential.curvature) return potential.curvature(potential.at);
  const Index n = potential.at.size();
  Matrix K = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    if (potential.unknowns[static_cast<std::size_t>(i)] >= 0)
      K.col(i) = derivative(
          [&](double step) {
            Vector u = potential.at;
            u[i] += step;
            return potential.gradient(u);
          },
          potential.steps[i]);
  return 0.5 * (K + K.transpose());
}

Vector gradient_rate(const Potential& potential) {
  double step = infinity;
  for (Index i = 0; i < potential.rates.size(); ++i)
    if (potential.rates[i] != 0.0) step = std::min(step, potential.steps[i] / std::abs(potential.rates[i]));
  if (!std::isfinite(step)) return {};
  return derivative([&](double along) { return potential.gradient(potential.at + along * potential.rates); }, step);
}

}  // namespace arcwall::verify
