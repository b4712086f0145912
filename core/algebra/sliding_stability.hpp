#pragma once

#include <vector>

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

/// C_x K⁻¹ B − C_s for motions in which contacts with friction that move along the body roll: columns of their
/// coordinates are at fixed slips, not at fixed places on the obstacle.
Matrix reduced_rolling(const BorderedSolver& solver, const Linearization& equations);

/// What a body resists motions by that the y_k of a border hold, where it may slide instead; and the sliding itself
/// where the energy is stationary in it.
struct SlidingResistance {
  std::vector<Index> released{};  ///< the y_k that are let go
  std::vector<Index> slides{};    ///< the s_k, by their columns of B, in which the energy is stationary
  Matrix T{};                     ///< moments at both, less the forces' own, by the motions there; symmetric

  /// How many more directions have negative energy than with all y_k holding; empty where T is not finite.
  std::optional<Index> negative() const;
};

/// Of the equations that `solver` has factorized, K being regular; their border_rates tell what is let go. Contacts
/// that slip do not.
SlidingResistance sliding_resistance(const BorderedSolver& solver, const Linearization& equations);

/// K with the y_k that a resistance names let go against it: singular where K is regular and ∂F/∂x is not.
class SlidingStabilityOperator {
 public:
  /// `solver` has factorized `equations`, K being regular. Both must outlive this.
  SlidingStabilityOperator(const BorderedSolver& solver, const Linearization& equations, SlidingResistance resistance);

  /// False where K is singular to working precision; then nothing else may be asked.
  bool is_finite() const;

  /// The lower triangle of K.
  const SparseMatrix& matrix() const { return K_; }

  /// The y_k that are let go.
  const std::vector<Index>& released() const { return released_; }

  /// Solutions in place.
  void solve(Eigen::Ref<Matrix> X) const;

  /// Of columns that solve() gave, or combinations of them.
  Matrix product(const Matrix& X) const;

 private:
  const Factorization& inner_;
  const SparseMatrix& K_;
  std::vector<Index> released_;
  Matrix slides_;                           // the columns of B of the s_k that are free
  Vector by_energy_;                        // the second derivatives of the energy by these
  Matrix moved_;                            // K⁻¹ R, R the unit columns of what is let go, then slides_
  Eigen::PartialPivLU<Matrix> resistance_;  // of T
};

}  // namespace arcwall
