#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "apps/verify/potentials.hpp"

// The rooms that potentials() is made of, and what they share; included by their sources alone.
namespace arcwall::verify {

/// Differences are taken over this part of an element's length, or this angle: truncation is then of the order 10⁻¹⁶,
/// and round-off of the energy over the step of the order 10⁻¹² of the forces.
constexpr double relative_step = 1e-4;
double step_of(Dof dof, double length);

/// The kind of each local unknown, by how many a node has: x, z, then a rotation, then changes of thickness.
Dof kind_of(std::size_t local, std::size_t stride);
std::size_t unknowns_a_node(const MemberMesh& mesh);

/// By λ, of the degrees of freedom that supports move.
using Rates = std::map<Index, double>;
Rates rates_of_supports(const Structure& structure);
double rate_of(const Rates& rates, Index dof);

/// Differences are taken over a part of the length over which an element or its foundation's law bends.
struct ElementSize {
  double length = 0.0, bends_over = infinity;

  double part() const { return std::min(1.0, bends_over / length); }
};

/// The narrowest piece of the laws of foundations along a member, over which their forces bend; ∞ without one.
double narrowest_piece(const deck::Deck& deck, const std::string& member);

/// Slender elements buckle in themselves at strains of EI/(EA h²): steps change the axial force by no more than a small
/// part of EI/h².
void limit_steps(double length, std::size_t stride, Potential& potential);

/// Elements between fixed nodes, with the loads and foundations along them.
std::vector<Potential> fixed_potentials(const Model& model, const State& state);

/// Elements between nodes that slide, likewise.
std::vector<Potential> sliding_potentials(const Model& model, const State& state);

/// The pressure of compliant walls on elements.
void add_compliant_walls(const Model& model, const State& state, std::vector<Potential>& to);

/// Springs at points and between two, as the deck has them.
void add_springs(const Model& model, const State& state, std::vector<Potential>& to);

/// What is left beside the areas where pressure ends.
void add_pressed_ends(const Model& model, const State& state, std::vector<Potential>& to);

}  // namespace arcwall::verify
