#include "apps/verify/potentials.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "apps/verify/differences.hpp"
#include "apps/verify/moved_unknowns.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

namespace {

// Differences are taken over this part of an element's length, or this angle: truncation is then of the order 10⁻¹⁶,
// and round-off of the energy over the step of the order 10⁻¹² of the forces.
constexpr double relative_step = 1e-4;

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

const SlidingMesh& sliding_mesh(const State& state) { return mesh_of(state); }

Vector coordinates(const State& state) { return state.x.tail(sliding_mesh(state).breakpoints()); }

// --- fixed nodes ----------------------------------------------------------------------------------------------------

// Length of each element, by its member.
std::vector<double> element_lengths(const Structure& structure) {
  std::vector<double> lengths;
  for (const MemberMesh& mesh : structure.members())
    lengths.insert(lengths.end(), mesh.nodes.size() - 1, mesh.length / double(mesh.nodes.size() - 1));
  return lengths;
}

using Rates = std::map<Index, double>;  // by λ, of the degrees of freedom that supports move

Rates rates_of_supports(const Structure& structure) {
  Rates rates;
  structure.nodal_terms().for_each_moved_support([&](Index dof, double rate) { rates[dof] = rate; });
  return rates;
}

double rate_of(const Rates& rates, Index dof) {
  const auto found = rates.find(dof);
  return found == rates.end() ? 0.0 : found->second;
}

// The kind of each local unknown, by how many a node has: x, z, then a rotation, then changes of thickness.
Dof kind_of(std::size_t local, std::size_t stride) {
  constexpr Dof kinds[] = {Dof::x, Dof::z, Dof::rotation, Dof::thickness, Dof::thickness2};
  return kinds[local % stride];
}

// The narrowest piece of the laws of foundations along a member, over which their forces bend; ∞ without one.
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

// Slender elements buckle in themselves at strains of EI/(EA h²): steps change the axial force by no more than a small
// part of EI/h². That is linear in what a step stretches, K_xi, and quadratic in what it turns the chord or an end.
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

// Differences are taken over a part of the length over which an element or its foundation's law bends.
struct ElementSize {
  double length = 0.0, bends_over = infinity;

  double part() const { return std::min(1.0, bends_over / length); }
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

// --- nodes that slide -----------------------------------------------------------------------------------------------

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

std::vector<Potential> sliding_potentials(const Model& model, const State& state) {
  std::vector<Potential> all;
  const SlidingMesh& mesh = sliding_mesh(state);
  const auto shared = std::make_shared<const SlidingElements>(
      SlidingElements{.mesh = mesh,
                      .s = coordinates(state),
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
      visit(body->unknown(sliding_mesh(state), dof).value_or(-1), load,
            body->value(sliding_mesh(state), mesh_state_of(state), dof));
    }
  }
}

// --- springs, as the deck has them ----------------------------------------------------------------------------------

// A degree of freedom of a place; none if there is no such.
std::optional<Index> dof_of(const Structure& structure, const deck::Deck& deck, const deck::Place& place, Dof which) {
  const bool turns = which == Dof::rotation;
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    const deck::Member& member = deck.members[m];
    const MemberMesh& mesh = structure.members()[m];
    const std::size_t last = mesh.nodes.size() - 1;
    const auto at = [&](std::size_t k) {
      return turns ? mesh.rotations[k] : std::optional(structure.dof(mesh.nodes[k], which));
    };
    if (place.fraction) {
      if (member.name == place.name) return at(static_cast<std::size_t>(std::lround(*place.fraction * double(last))));
      continue;
    }
    if (member.from == place.name && !(turns && (member.hinge_from || !at(0)))) return at(0);
    if (member.to == place.name && !(turns && (member.hinge_to || !at(last)))) return at(last);
  }
  return std::nullopt;
}

// Its integral from 0, by Simpson's rule between the points, which is exact for cubics.
double table_energy(const deck::TableLaw& law, double stretch) {
  const double least = std::min(0.0, stretch), greatest = std::max(0.0, stretch);
  std::vector<double> places{least};
  for (const double u : law.displacement)
    if (u > least && u < greatest) places.push_back(u);
  places.push_back(greatest);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double a = places[i], b = places[i + 1];
    sum += (b - a) / 6.0 * (table_force(law, a) + 4.0 * table_force(law, 0.5 * (a + b)) + table_force(law, b));
  }
  return stretch < 0.0 ? -sum : sum;
}

// The slope of straight pieces before point i of the table, beyond its ends 0.
double slope_before(const deck::TableLaw& law, std::size_t i) {
  if (i == 0 || i == law.displacement.size()) return 0.0;
  return (law.force[i] - law.force[i - 1]) / (law.displacement[i] - law.displacement[i - 1]);
}

bool is_kink(const deck::TableLaw& law, std::size_t i) {
  constexpr double same = 1e-12;  // relative
  const double before = slope_before(law, i), behind = slope_before(law, i + 1);
  return std::abs(behind - before) > same * std::max(std::abs(behind), std::abs(before));
}

// A law as the straight piece on which a stretch is, carried on: at a kink the state's piece says which of two that is.
struct StraightPiece {
  double from = 0.0, force = 0.0, slope = 0.0, energy = 0.0;

  double force_at(double u) const { return force + slope * (u - from); }
  double energy_at(double u) const { return energy + (u - from) * (force + 0.5 * slope * (u - from)); }
};

StraightPiece straight_piece(const deck::TableLaw& law, double stretch, const State& state, std::size_t first_kink) {
  constexpr double at_kink = 1e-9;  // of the table's width
  const auto& u = law.displacement;
  const double near = at_kink * (u.back() - u.front());
  std::size_t piece = 0, kink = state.active_set.contacts() + first_kink;  // points of the table that are passed
  for (std::size_t i = 0; i < u.size(); ++i) {
    bool passed = stretch >= u[i];
    const bool kinked = is_kink(law, i);
    if (kinked && state.active_set.kinks() > 0 && std::abs(stretch - u[i]) <= near)
      passed = (state.active_set[kink] != 0) == (u[i] >= 0.0);
    kink += kinked ? 1 : 0;
    if (passed) piece = i + 1;
  }
  const std::size_t point = piece == 0 ? 0 : piece - 1;
  return {.from = u[point],
          .force = law.force[point],
          .slope = slope_before(law, piece),
          .energy = table_energy(law, u[point])};
}

// How many kinks of laws stand before those of a spring.
std::size_t kinks_before(const deck::Deck& deck, const deck::Spring& spring) {
  std::size_t kinks = 0;
  for (const deck::Spring& other : deck.springs) {
    if (&other == &spring) break;
    if (std::holds_alternative<deck::Foundation>(other.kind)) continue;
    const auto* const law = std::visit([](const auto& kind) { return kind.law ? &*kind.law : nullptr; }, other.kind);
    if (law == nullptr || law->interpolation != SpringLaw::Interpolation::linear) continue;
    for (std::size_t i = 0; i < law->displacement.size(); ++i) kinks += is_kink(*law, i) ? 1 : 0;
  }
  return kinks;
}

// The potential of a spring between two degrees of freedom, or of one to the ground, by its stretch: ½ k s² or that of
// a law.
Potential spring_potential(const Model& model, const State& state, double k, const deck::TableLaw* law,
                           std::size_t first_kink, const std::vector<Index>& dofs, Dof which) {
  const auto n = static_cast<Index>(dofs.size());
  Potential potential{.at = Vector(n),
                      .steps = Vector::Constant(n, step_of(which, model.structure().length_scale())),
                      .rates = Vector::Zero(n)};
  const Rates rates = rates_of_supports(model.structure());
  for (Index i = 0; i < n; ++i) {
    const Index dof = dofs[static_cast<std::size_t>(i)];
    potential.rates[i] = rate_of(rates, dof);
    const SlidingStructure* body = model.sliding_structure();
    const auto unknown = body != nullptr ? body->unknown(sliding_mesh(state), dof) : model.structure().unknown(dof);
    potential.unknowns.push_back(unknown.value_or(-1));
    potential.at[i] = body != nullptr ? body->value(sliding_mesh(state), mesh_state_of(state), dof)
                                      : model.structure().value(state, dof);
  }
  const Vector by = n == 1 ? Vector::Ones(1) : Vector(Vec2(-1.0, 1.0));  // of the stretch
  const auto stretch = [by](const Vector& u) { return by.dot(u); };
  if (law != nullptr && law->interpolation == SpringLaw::Interpolation::linear) {
    const StraightPiece piece = straight_piece(*law, stretch(potential.at), state, first_kink);
    potential.energy = [=](const Vector& u) { return piece.energy_at(stretch(u)); };
    potential.gradient = [=](const Vector& u) { return Vector(piece.force_at(stretch(u)) * by); };
    potential.curvature = [=](const Vector&) { return Matrix(piece.slope * by * by.transpose()); };
    return potential;
  }
  potential.energy = [=](const Vector& u) {
    return law != nullptr ? table_energy(*law, stretch(u)) : 0.5 * k * stretch(u) * stretch(u);
  };
  potential.gradient = [=](const Vector& u) {
    return Vector((law != nullptr ? table_force(*law, stretch(u)) : k * stretch(u)) * by);
  };
  potential.curvature = [=](const Vector& u) {
    return Matrix((law != nullptr ? table_slope(*law, stretch(u)) : k) * by * by.transpose());
  };
  return potential;
}

// Of a spring at points in one direction; empty where it does not act, and of a foundation, which is part of its
// elements.
std::optional<Potential> spring_potential(const Model& model, const State& state, const deck::Spring& spring,
                                          Dof which) {
  std::vector<deck::Place> places;
  deck::Stiffness stiffness;
  const deck::TableLaw* law = nullptr;
  if (const auto* ground = std::get_if<deck::GroundSpring>(&spring.kind)) {
    places = {ground->at};
    stiffness = ground->stiffness;
    if (ground->law) law = &*ground->law;
  } else if (const auto* between = std::get_if<deck::PointToPointSpring>(&spring.kind)) {
    for (const std::string& point : between->points) places.push_back({.name = point});
    stiffness = between->stiffness;
    if (between->law) law = &*between->law;
  }
  const double k = which == Dof::x ? stiffness.x : which == Dof::z ? stiffness.z : stiffness.rotation;
  std::vector<Index> dofs;
  for (const deck::Place& place : places)
    if (const auto dof = dof_of(model.structure(), model.deck(), place, which)) dofs.push_back(*dof);
  const bool acts = law != nullptr ? law->direction == which : k > 0.0;
  if (!acts || places.empty() || dofs.size() != places.size()) return std::nullopt;
  return spring_potential(model, state, k, law, kinks_before(model.deck(), spring), dofs, which);
}

void add_springs(const Model& model, const State& state, std::vector<Potential>& to) {
  for (const deck::Spring& spring : model.deck().springs)
    for (const Dof which : {Dof::x, Dof::z, Dof::rotation})
      if (auto potential = spring_potential(model, state, spring, which)) to.push_back(std::move(*potential));
}

// Where pressure ends, ½ p (−z δx + x δz) of the place (x, z) is left beside the areas: with z given, −½ p z x, and
// with x given ½ p x z. With both given it is p times the area between the ways to them, of constant parts c and then
// of λ d, and the rest place: ½ (x₀ u_z − z₀ u_x + λ c × d).
void add_pressed_ends(const Model& model, const State& state, std::vector<Potential>& to) {
  const SlidingStructure* body = model.sliding_structure();
  for (const NodalTerms::PressedEnd& end : model.structure().nodal_terms().pressed_ends()) {
    Potential potential{.at = Vector(2),
                        .steps = Vector::Constant(2, relative_step * model.structure().length_scale()),
                        .rates = Vector::Zero(2)};
    const Rates rates = rates_of_supports(model.structure());
    for (const Index dof : {end.x, end.z}) {
      const Index i = static_cast<Index>(potential.unknowns.size());
      potential.rates[i] = rate_of(rates, dof);
      const auto unknown = body != nullptr ? body->unknown(sliding_mesh(state), dof) : model.structure().unknown(dof);
      potential.unknowns.push_back(unknown.value_or(-1));
      potential.at[i] = body != nullptr ? body->value(sliding_mesh(state), mesh_state_of(state), dof)
                                        : model.structure().value(state, dof);
    }
    const bool is_given = potential.unknowns[0] < 0 && potential.unknowns[1] < 0;
    const double by_x = is_given || potential.unknowns[0] >= 0 ? -1.0 : 0.0;
    const double by_z = is_given || potential.unknowns[1] >= 0 ? 1.0 : 0.0;
    const Vec2 rates_of_place = potential.rates, constant = Vec2(potential.at) - state.lambda * rates_of_place;
    const double beside = is_given ? state.lambda * cross(constant, rates_of_place) : 0.0;
    const double p = end.excess.at(state.lambda);
    const Vec2 rest = end.rest;
    potential.energy = [=](const Vector& u) {
      return 0.5 * p * (by_x * (rest.y() + u[1]) * u[0] + by_z * (rest.x() + u[0]) * u[1] + beside);
    };
    potential.gradient = [=](const Vector& u) {
      return Vector(0.5 * p * Vec2(by_x * (rest.y() + u[1]) + by_z * u[1], by_z * (rest.x() + u[0]) + by_x * u[0]));
    };
    potential.curvature = [=](const Vector&) {
      Matrix K = Matrix::Zero(2, 2);
      K(0, 1) = K(1, 0) = 0.5 * p * (by_x + by_z);
      return K;
    };
    to.push_back(std::move(potential));
  }
}

}  // namespace

namespace {

// The force of a law by a stretch and its slope: between two points of the table a straight line, or Hermite's cubic,
// with the slopes of Fritsch and Butland, 0 at the ends.
std::pair<double, double> table_force_and_slope(const deck::TableLaw& law, double stretch) {
  const auto& u = law.displacement;
  const auto& force = law.force;
  if (stretch <= u.front()) return {force.front(), 0.0};
  if (stretch >= u.back()) return {force.back(), 0.0};
  std::size_t i = 0;
  while (u[i + 1] < stretch) ++i;
  if (law.interpolation == SpringLaw::Interpolation::linear)
    return {(force[i] * (u[i + 1] - stretch) + force[i + 1] * (stretch - u[i])) / (u[i + 1] - u[i]),
            slope_before(law, i + 1)};
  const auto slope = [&](std::size_t at) {
    if (at == 0 || at + 1 == u.size()) return 0.0;
    const double h0 = u[at] - u[at - 1], h1 = u[at + 1] - u[at];
    const double s0 = (force[at] - force[at - 1]) / h0, s1 = (force[at + 1] - force[at]) / h1;
    return s0 * s1 > 0.0 ? 1.0 / ((h0 + 2.0 * h1) / (3.0 * (h0 + h1) * s0) + (2.0 * h0 + h1) / (3.0 * (h0 + h1) * s1))
                         : 0.0;
  };
  const double h = u[i + 1] - u[i], t = (stretch - u[i]) / h;
  const double c = h * slope(i), d = force[i + 1] - force[i], e = h * slope(i + 1);
  const double second = 3.0 * d - 2.0 * c - e, third = c + e - 2.0 * d;
  return {force[i] + t * (c + t * (second + t * third)), (c + t * (2.0 * second + 3.0 * t * third)) / h};
}

}  // namespace

double table_force(const deck::TableLaw& law, double stretch) { return table_force_and_slope(law, stretch).first; }

double greatest_energy(const deck::TableLaw& law) {
  double most = 0.0;
  for (const double u : law.displacement) most = std::max(most, std::abs(table_energy(law, u)));
  return most;
}

double table_slope(const deck::TableLaw& law, double stretch) { return table_force_and_slope(law, stretch).second; }

std::vector<Potential> potentials(const Model& model, const State& state) {
  std::vector<Potential> all =
      model.sliding() != nullptr ? sliding_potentials(model, state) : fixed_potentials(model, state);
  add_compliant_walls(model, state, all);
  add_springs(model, state, all);
  add_pressed_ends(model, state, all);
  return all;
}

std::optional<double> spring_force(const Model& model, const State& state, const deck::Spring& spring, Dof which) {
  const auto potential = spring_potential(model, state, spring, which);
  if (!potential) return std::nullopt;
  const Vector gradient = potential->gradient(potential->at);
  return gradient[gradient.size() - 1];
}

Index structure_unknowns(const Model& model, const State& state) {
  return model.sliding() != nullptr ? sliding_mesh(state).unknowns() : model.structure().size({});
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
  const SlidingMesh& mesh = sliding_mesh(state);
  for (Index strand = 0; strand < model.sliding_structure()->strands(); ++strand)
    for (Index position = 0; position < mesh.nodes(strand); ++position) {
      const NodeUnknowns unknowns = mesh.node_unknowns(strand, position);
      const auto found = std::find(unknowns.begin(), unknowns.end(), unknown);
      if (found == unknowns.end()) continue;
      const auto [member, fraction] = model.sliding_structure()->label(
          {.strand = strand, .s = mesh.coordinate(strand, position, coordinates(state))});
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
