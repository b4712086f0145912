#include <cmath>

#include "apps/verify/potential_rooms.hpp"

namespace arcwall::verify {

namespace {

// Length of each element, by its member.
std::vector<double> element_lengths(const Structure& structure) {
  std::vector<double> lengths;
  for (const MemberMesh& mesh : structure.members())
    lengths.insert(lengths.end(), mesh.nodes.size() - 1, mesh.length / double(mesh.nodes.size() - 1));
  return lengths;
}

struct LoadedElement {
  const Element* element;
  std::vector<const Element*> loads;
  double lambda;

  double energy(const Vector& u) const {
    double sum = element->evaluate_at(u.data(), lambda, nullptr, nullptr, nullptr);
    for (const Element* load : loads) sum += load->evaluate_at(u.data(), lambda, nullptr, nullptr, nullptr);
    return sum;
  }
  Vector gradient(const Vector& u) const {
    Vector sum(u.size()), part(u.size());
    element->evaluate_at(u.data(), lambda, sum.data(), nullptr, nullptr);
    for (const Element* load : loads) {
      load->evaluate_at(u.data(), lambda, part.data(), nullptr, nullptr);
      sum += part;
    }
    return sum;
  }
};

// The unknowns of an element, their values and steps; what it is a potential of is left out.
Potential on_element(const Structure& structure, Index e, const State& state, std::size_t stride,
                     const ElementSize& size, const Rates& rates) {
  const auto dofs = structure.element_dofs(e);
  const auto n = static_cast<Index>(dofs.size());
  Potential potential{.at = Vector(n), .steps = Vector(n), .rates = Vector::Zero(n)};
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto local = static_cast<Index>(i);
    potential.rates[local] = rate_of(rates, dofs[i]);
    potential.unknowns.push_back(structure.unknown(dofs[i]).value_or(-1));
    potential.at[local] = structure.value(state, dofs[i]);
    potential.steps[local] = size.part() * step_of(kind_of(i, stride), size.length);
  }
  return potential;
}

Potential fixed_potential(const Structure& structure, Index e, const State& state, std::size_t stride,
                          const ElementSize& size, const Rates& rates) {
  LoadedElement loaded{.element = &structure.element(e), .loads = {}, .lambda = state.lambda};
  for (const std::uint32_t i : structure.loads_of_element(e))
    if (!structure.element_loads()[i].wall) loaded.loads.push_back(structure.element_loads()[i].potential.get());
  Potential potential = on_element(structure, e, state, stride, size, rates);
  potential.energy = [loaded](const Vector& u) { return loaded.energy(u); };
  potential.gradient = [loaded](const Vector& u) { return loaded.gradient(u); };
  limit_steps(size.length, stride, potential);
  return potential;
}

}  // namespace

std::vector<Potential> fixed_potentials(const Model& model, const State& state) {
  const Structure& structure = model.structure();
  std::vector<Potential> all;
  const std::vector<double> lengths = element_lengths(structure);
  const Rates rates = rates_of_supports(structure);
  for (const MemberMesh& mesh : structure.members()) {
    const double bends_over = narrowest_piece(model.deck(), mesh.name);
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) {
      const ElementSize size{.length = lengths[all.size()], .bends_over = bends_over};
      const auto e = static_cast<Index>(all.size());
      all.push_back(fixed_potential(structure, e, state, unknowns_a_node(mesh), size, rates));
    }
  }
  return all;
}

namespace {

// The pressure of a compliant wall on an element. Its energy has kinks in its derivatives where edges of contact pass,
// over which differences are wrong: see check_compliant_walls().
Potential wall_potential(const Structure& structure, const Structure::ElementLoad& load, const State& state,
                         std::size_t stride, double length, const Rates& rates) {
  Potential potential = on_element(structure, load.element, state, stride, {.length = length}, rates);
  const Element* const wall = load.potential.get();
  const double lambda = state.lambda;
  potential.energy = [=](const Vector& u) { return wall->evaluate_at(u.data(), lambda, nullptr, nullptr, nullptr); };
  potential.gradient = [=](const Vector& u) {
    Vector f(u.size());
    wall->evaluate_at(u.data(), lambda, f.data(), nullptr, nullptr);
    return f;
  };
  potential.curvature = [=](const Vector& u) {
    Vector f(u.size());
    Matrix K(u.size(), u.size());
    wall->evaluate_at(u.data(), lambda, f.data(), K.data(), nullptr);
    return Matrix(K.selfadjointView<Eigen::Lower>());
  };
  return potential;
}

}  // namespace

void add_compliant_walls(const Model& model, const State& state, std::vector<Potential>& to) {
  const Structure& structure = model.structure();
  const std::vector<double> lengths = element_lengths(structure);
  const Rates rates = rates_of_supports(structure);
  for (const Structure::ElementLoad& load : structure.element_loads()) {
    if (!load.wall || !load.acts_on(state)) continue;
    const CompliantContact::Wall& wall = model.compliant()->wall(static_cast<Index>(*load.wall));
    const std::size_t stride = unknowns_a_node(structure.members()[static_cast<std::size_t>(wall.member)]);
    to.push_back(
        wall_potential(structure, load, state, stride, lengths[static_cast<std::size_t>(load.element)], rates));
  }
}

}  // namespace arcwall::verify
