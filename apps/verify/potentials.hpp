#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace arcwall::verify {

/// A part of the total potential at a state: of one element with the loads and springs along it, or of a spring.
struct Potential {
  std::vector<Index> unknowns{};                    ///< −1: a support holds it
  Vector at{};                                      ///< their values; those of held ones do not vary
  Vector steps{};                                   ///< with which differences are taken
  Vector rates{};                                   ///< by λ, of those that supports move; empty: none moves
  std::function<double(const Vector&)> energy{};    ///< [force·length]
  std::function<Vector(const Vector&)> gradient{};  ///< as the element has it
  /// Of what is no element, whose gradient is in closed form, too: laws have kinks, over which differences are wrong.
  std::function<Matrix(const Vector&)> curvature{};
};

/// All of them, whether the mesh slides or not.
std::vector<Potential> potentials(const Model& model, const State& state);

/// The force of a spring at points in one direction, as its deck has it, on its second place where it has two; empty
/// where it does not act.
std::optional<double> spring_force(const Model& model, const State& state, const deck::Spring& spring, Dof which);

/// The force of a law at a stretch, by formulas of its own.
double table_force(const deck::TableLaw& law, double stretch);

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

/// ∂U/∂u of a potential: of an element by differences of its energy alone.
Vector forces(const Potential& potential);

/// ∂²U/∂u²: of an element by differences of its gradient.
Matrix stiffness(const Potential& potential);

/// How its gradient changes with λ while supports alone move, by differences too; empty where none does.
Vector gradient_rate(const Potential& potential);

}  // namespace arcwall::verify
