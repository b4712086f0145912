#pragma once

#include <vector>

#include "core/linearization.hpp"
#include "core/state.hpp"

namespace arcwall {

/// The first of three levels of a system: equilibrium equations F(x, λ) = 0 that are smooth on each piece.
///
/// A piece says which contacts are closed and what the unknowns mean; equations without contact have one, the empty
/// piece. x has size(piece) entries in whatever units the implementation gives its unknowns, and weights() makes them
/// comparable. F is internal minus external force; a unit of F_i times one of x_i is an energy.
///
/// Must be overridden: size, residual, linearize and energy. Must hold: residual() and linearize() give the same F;
/// K, B, C and F_λ are its derivatives; K is symmetric; without multipliers F is the gradient of the energy
/// (check_derivatives() in core/derivative_check.hpp tells). Immutable: every function is const and depends on its
/// arguments alone, so that a step can be retried, bisected or branched.
class Equations {
 public:
  virtual ~Equations() = default;

  /// Number of unknowns on a piece: those of the structure, then one contact force a closed contact.
  virtual Index size(const Piece& piece) const = 0;

  /// F; has size(state.piece) entries.
  virtual void residual(const State& state, Eigen::Ref<Vector> F) const = 0;

  /// F, K and F_λ. Lays out the pattern of K when `out` was last used on another piece.
  virtual void linearize(const State& state, Linearization& out) const = 0;

  /// Total potential energy: strain energy minus the work of the loads [force·length].
  virtual double energy(const State& state) const = 0;

  /// Weights of the squared norm of x in the path metric: Σ w_i x_i² is dimensionless. Not negative, and 0 for
  /// multipliers; size(piece) entries.
  virtual Vector weights(const Piece& piece) const { return Vector::Ones(size(piece)) / double(size(piece)); }

  /// Square of the length, in that metric, by which λ itself moves supports and obstacles, or makes members
  /// expand, per unit.
  virtual double squared_motion_by_lambda(const Piece&) const { return 0.0; }

  /// Of each unknown the set that it is in, or −1. All unknowns of a set may grow by 2π while F stays what it is, so
  /// that the state is the same: rotations. Empty where there are no such sets; it may end before the multipliers.
  virtual std::vector<Index> turning_sets(const Piece&) const { return {}; }

  /// How many unknowns at the end of those of K are multipliers: forces and moments that enforce constraints, in whose
  /// rows K has no diagonal, or a negative one. Each takes a negative eigenvalue of K, which stability does not count.
  virtual Index multiplier_count(const Piece&) const { return 0; }

  /// Whether eigenvalues of K tell how many directions are unstable. Not of equations that no structure is in
  /// equilibrium by, as those of an event that is followed: then nothing is counted, and branch points are not looked
  /// for.
  virtual bool has_stability() const { return true; }
};

}  // namespace arcwall
