#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "apps/verify/potentials.hpp"

// The rooms that potentials() is made of, and what they share; included by their sources alone.
namespace arcwall::verify {

/// By λ, of the degrees of freedom that supports move.
using Rates = std::map<Index, double>;
Rates rates_of_supports(const Structure& structure);
double rate_of(const Rates& rates, Index dof);

/// Elements between fixed nodes, with the loads and foundations along them.
std::vector<Potential> fixed_potentials(const Model& model, const PlainMembers& members, const State& state);

/// Elements between nodes that slide, likewise.
std::vector<Potential> sliding_potentials(const Model& model, const PlainMembers& members, const State& state);

/// The pressure of compliant walls on elements, as the elements of the model have it: between the edges of contact it
/// is integrated by parts that the theory leaves open. See check_compliant_walls().
void add_compliant_walls(const Model& model, const State& state, std::vector<Potential>& to);

/// Springs at points and between two, as the deck has them.
void add_springs(const Model& model, const State& state, std::vector<Potential>& to);

/// What is left beside the areas where pressure ends.
void add_pressed_ends(const Model& model, const State& state, std::vector<Potential>& to);

}  // namespace arcwall::verify
