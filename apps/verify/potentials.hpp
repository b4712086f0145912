#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/verify/plain_member.hpp"
#include "apps/verify/strain_energy.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// A part of the total potential at a state: of one element with the loads and springs along it, or of a spring.
struct Potential : LocalEnergy {
  std::vector<Index> unknowns{};  ///< −1: a support holds it
  Vector rates{};                 ///< by λ, of those that supports move; empty: none moves
};

/// All of them, whether the mesh slides or not. The energy of an element is that of strain_energy.hpp, with what is
/// along it as line_energy.hpp has it.
std::vector<Potential> potentials(const Model& model, const PlainMembers& members, const State& state);

/// The force of a spring at points in one direction, as its deck has it, on its second place where it has two; empty
/// where it does not act.
std::optional<double> spring_force(const Model& model, const State& state, const deck::Spring& spring, Dof which);

/// The force of a law at a stretch, by formulas of its own.
double table_force(const deck::TableLaw& law, double stretch);

/// Its integral from 0.
double table_energy(const deck::TableLaw& law, double stretch);

/// The greatest energy at a point of its table: energies between are differences of such.
double greatest_energy(const deck::TableLaw& law);

/// Its slope there.
double table_slope(const deck::TableLaw& law, double stretch);

/// Point loads on the unknowns.
Vector point_loads(const Model& model, const State& state);

/// Their work: loads times displacements from rest.
double work_of_point_loads(const Model& model, const State& state);

/// Number of unknowns of the structure, which stand first in a state's.
Index structure_unknowns(const Model& model, const State& state);

/// What an unknown of the structure is: `z at column:0.5`.
std::string name_of_unknown(const Model& model, const State& state, Index unknown);

/// How its gradient changes with λ while supports alone move; empty where none does.
Vector gradient_rate(const Potential& potential);

}  // namespace arcwall::verify
