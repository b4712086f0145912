#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/state.hpp"

namespace arcwall {

/// The equations F(x, λ) = 0 at one state, with their derivatives. Reused from state to state: while the piece stays
/// the same, the pattern of K does, and only values are written.
struct Linearization {
  Vector F{};                              ///< residual, internal minus external
  SparseMatrix K{};                        ///< ∂F/∂x, symmetric: the lower triangle alone is stored
  Vector F_lambda{};                       ///< ∂F/∂λ
  std::optional<Piece> pattern_of{};       ///< the piece whose pattern K has; empty: not laid out yet
  std::unique_ptr<Linearization> inner{};  ///< workspace of a system that wraps another
};

/// Equilibrium equations F(x, λ) = 0 with unilateral side conditions (guards). Immutable: every function is const and
/// depends on its arguments alone, so that a step can be retried, bisected or branched.
///
/// A smooth system overrides the first group only.
class System {
 public:
  virtual ~System() = default;

  /// Number of unknowns on a piece: those of the structure, then one contact force a closed contact.
  virtual Index size(const Piece& piece) const = 0;

  /// F; has size(state.piece) entries.
  virtual void residual(const State& state, Eigen::Ref<Vector> F) const = 0;

  /// F, K and F_λ. Lays out the pattern of K when `out` was last used on another piece.
  virtual void linearize(const State& state, Linearization& out) const = 0;

  /// Total potential energy: strain energy minus the work of the loads [force·length].
  virtual double energy(const State& state) const = 0;

  /// Weights of the squared norm of x in the path metric: Σ w_i x_i² is dimensionless; 0 for multipliers.
  virtual Vector weights(const Piece& piece) const { return Vector::Ones(size(piece)) / double(size(piece)); }

  /// How many unknowns at the end of x are contact forces.
  virtual Index multiplier_count(const Piece&) const { return 0; }

  // --- guards: side conditions that say how far a piece reaches -------------------------------------------------

  virtual Index guard_count() const { return 0; }

  /// Scaled to order 1 and ≥ 0 on this piece: the gap of an open contact, the force of a closed one. A guard that
  /// cannot be reached is large.
  virtual Vector guards(const State&) const { return {}; }

  /// Derivative of guard j, scaled likewise.
  virtual Row guard_gradient(const State& state, Index) const {
    return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  }

  /// Derivatives of all guards along a direction.
  virtual Vector guard_rates(const State& state, const Direction& direction) const {
    Vector rates(guard_count());
    for (Index j = 0; j < rates.size(); ++j) rates[j] = apply(guard_gradient(state, j), direction);
    return rates;
  }

  /// Guards whose gap and force both vanish within `tolerance` (in the scale of guards()).
  virtual std::vector<Index> weak_guards(const State&, double /*tolerance*/) const { return {}; }

  /// −∂F/∂p_j, the unit response of contact j, for a state on a piece where j is open; scaled so that it belongs to a
  /// change of 1 of the guard `force of j`.
  virtual Vector unit_force(const State& state, Index) const { return Vector::Zero(state.x.size()); }

  /// Where the force of a closed contact stands in x; empty for an open one.
  virtual std::optional<Index> multiplier_index(const Piece&, Index) const { return std::nullopt; }

  /// The value in x of a multiplier whose guard is 1.
  virtual double multiplier_scale() const { return 1.0; }

  /// The same point with the unknowns of another piece: forces that are new are zero.
  virtual Vector transfer(const Vector& x, const Piece&, const Piece&) const { return x; }

  /// Why the equations do not hold at this state although it may solve them (a wall that ends); empty if they do.
  virtual std::optional<std::string> obstruction(const State&) const { return std::nullopt; }

  /// The same point on another piece.
  State with_piece(const State& state, const Piece& piece) const {
    return {.x = transfer(state.x, state.piece, piece), .lambda = state.lambda, .piece = piece};
  }
};

}  // namespace arcwall
