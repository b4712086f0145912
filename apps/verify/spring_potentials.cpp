#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/verify/potential_rooms.hpp"

namespace arcwall::verify {

namespace {

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

// What a potential of degrees of freedom is by: its unknowns, and the displacements, which are returned.
Vector values_of(const Model& model, const State& state, const std::vector<Index>& dofs, Potential& potential) {
  const Rates rates = rates_of_supports(model.structure());
  const SlidingStructure* body = model.sliding_structure();
  Vector u(static_cast<Index>(dofs.size()));
  potential.rates = Vector::Zero(u.size());
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const auto i = static_cast<Index>(k);
    const auto unknown = body != nullptr ? body->unknown(mesh_of(state), dofs[k]) : model.structure().unknown(dofs[k]);
    potential.unknowns.push_back(unknown.value_or(-1));
    potential.rates[i] = rate_of(rates, dofs[k]);
    u[i] = body != nullptr ? body->value(mesh_of(state), mesh_state_of(state), dofs[k])
                           : model.structure().value(state, dofs[k]);
  }
  return u;
}

// Energy, force and stiffness of a spring at a stretch.
struct SpringResponse {
  double energy = 0.0, force = 0.0, stiffness = 0.0;
};

// The potential of a spring between two degrees of freedom, or of one to the ground, by its stretch: ½ k s² or that of
// a law.
Potential spring_potential(const Model& model, const State& state, double k, const deck::TableLaw* law,
                           std::size_t first_kink, const std::vector<Index>& dofs) {
  Potential potential;
  const Vector u = values_of(model, state, dofs, potential);
  const Vector by = u.size() == 1 ? Vector::Ones(1) : Vector(Vec2(-1.0, 1.0));  // of the stretch
  const double stretch = by.dot(u);
  const SpringResponse here = [&]() -> SpringResponse {
    if (law == nullptr) return {.energy = 0.5 * k * stretch * stretch, .force = k * stretch, .stiffness = k};
    if (law->interpolation == SpringLaw::Interpolation::linear) {
      const StraightPiece piece = straight_piece(*law, stretch, state, first_kink);
      return {.energy = piece.energy_at(stretch), .force = piece.force_at(stretch), .stiffness = piece.slope};
    }
    return {.energy = table_energy(*law, stretch),
            .force = table_force(*law, stretch),
            .stiffness = table_slope(*law, stretch)};
  }();
  potential.energy = here.energy;
  potential.gradient = here.force * by;
  potential.stiffness = here.stiffness * by * by.transpose();
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
  return spring_potential(model, state, k, law, kinks_before(model.deck(), spring), dofs);
}

}  // namespace

void add_springs(const Model& model, const State& state, std::vector<Potential>& to) {
  for (const deck::Spring& spring : model.deck().springs)
    for (const Dof which : {Dof::x, Dof::z, Dof::rotation})
      if (auto potential = spring_potential(model, state, spring, which)) to.push_back(std::move(*potential));
}

// Where pressure ends, ½ p (−z δx + x δz) of the place (x, z) is left beside the areas: with z given, −½ p z x, and
// with x given ½ p x z. With both given it is p times the area between the ways to them, of constant parts c and then
// of λ d, and the rest place: ½ (x₀ u_z − z₀ u_x + λ c × d).
void add_pressed_ends(const Model& model, const State& state, std::vector<Potential>& to) {
  for (const NodalTerms::PressedEnd& end : model.structure().nodal_terms().pressed_ends()) {
    Potential potential;
    const Vec2 u = values_of(model, state, {end.x, end.z}, potential), rates_of_place = potential.rates;
    const bool is_given = potential.unknowns[0] < 0 && potential.unknowns[1] < 0;
    const double by_x = is_given || potential.unknowns[0] >= 0 ? -1.0 : 0.0;
    const double by_z = is_given || potential.unknowns[1] >= 0 ? 1.0 : 0.0;
    const Vec2 constant = u - state.lambda * rates_of_place;
    const double beside = is_given ? state.lambda * cross(constant, rates_of_place) : 0.0;
    const double half = 0.5 * end.excess.at(state.lambda);
    const Vec2 place = end.rest + u;
    potential.energy = half * (by_x * place.y() * u.x() + by_z * place.x() * u.y() + beside);
    potential.gradient = half * Vec2(by_x * place.y() + by_z * u.y(), by_z * place.x() + by_x * u.x());
    potential.stiffness = Matrix::Zero(2, 2);
    potential.stiffness(0, 1) = potential.stiffness(1, 0) = half * (by_x + by_z);
    to.push_back(std::move(potential));
  }
}

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

double greatest_energy(const deck::TableLaw& law) {
  double most = 0.0;
  for (const double u : law.displacement) most = std::max(most, std::abs(table_energy(law, u)));
  return most;
}

double table_slope(const deck::TableLaw& law, double stretch) { return table_force_and_slope(law, stretch).second; }
std::optional<double> spring_force(const Model& model, const State& state, const deck::Spring& spring, Dof which) {
  const auto potential = spring_potential(model, state, spring, which);
  if (!potential) return std::nullopt;
  return potential->gradient[potential->gradient.size() - 1];
}

}  // namespace arcwall::verify
