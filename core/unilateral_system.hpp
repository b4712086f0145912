#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/equations.hpp"

namespace arcwall {

/// Guards of a piece at a state that moves: their values, and their derivatives along its direction.
struct GuardsAlong {
  Vector values{}, rates{};
};

/// The second of three levels of a system: equations with unilateral side conditions.
///
/// There are as many contacts as a piece has entries. Contact j is open (its gap g_j ≥ 0, its force 0) or closed (its
/// gap 0, its force p_j ≥ 0, an unknown). What must not become negative is its *guard*: the gap of an open contact, the
/// force of a closed one, each over a scale of the implementation's choice, so that guards are of order 1. Where a
/// guard vanishes the path has come to the end of the piece.
///
/// A kink of a law of straight pieces is a contact that gives way: its gap is the stretch that is left up to the kink,
/// its force the stretch beyond it, its compliance 1. No multiplier stands for it (multiplier_index).
///
/// Must be overridden by a system with contacts: open_piece, guards, guard_gradient, unit_force, multiplier_index and
/// transfer, and of the equations multiplier_count. Must hold: guard_gradient() is the derivative of guards(), and
/// guard() and guards_along() agree with both; a force enters the equations by the gradient of its gap, so that K stays
/// symmetric; transfer() from a piece to another and back gives the same x where the forces that are left out are zero.
class UnilateralSystem : public Equations {
 public:
  /// No contact closed, unknowns as a path from rest begins with.
  virtual Piece open_piece() const { return {}; }

  /// Number of guards of a piece: those of its contacts and, behind them, of its validity bounds (see System).
  virtual Index guard_count(const Piece& piece) const { return static_cast<Index>(piece.size()); }

  /// All guards, dimensionless. One that cannot be reached is large.
  virtual Vector guards(const State&) const { return {}; }

  /// Guard j alone.
  virtual double guard(const State& state, Index j) const { return guards(state)[j]; }

  /// Derivative of guard j.
  virtual Row guard_gradient(const State& state, Index) const {
    return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  }

  /// All guards, and how they change along a direction.
  virtual GuardsAlong guards_along(const State& state, const Direction& direction) const {
    GuardsAlong along{.values = guards(state), .rates = Vector(guard_count(state.piece))};
    for (Index j = 0; j < along.rates.size(); ++j) along.rates[j] = apply(guard_gradient(state, j), direction);
    return along;
  }

  /// What guard j watches, for messages: an obstacle and a place of the structure. May be empty.
  virtual std::string watched_place(const State&, Index /*j*/) const { return {}; }

  /// −∂F/∂p_j for a state on a piece where contact j is open: what its force would do to the equations, scaled so that
  /// it belongs to a change of 1 of the guard that the force is on the piece where j is closed.
  virtual Vector unit_force(const State& state, Index) const { return Vector::Zero(state.x.size()); }

  /// How far a closed contact gives way for its force, both in the scale of the guards: its gap is −compliance times
  /// its force. Zero for rigid obstacles.
  virtual double compliance(const Piece&, Index) const { return 0.0; }

  /// Whether a contact of a piece holds in both senses: it is closed all along a path, whatever the sign of its force,
  /// and holds without one, too. Its guard never vanishes.
  virtual bool is_two_sided(const Piece&, Index) const { return false; }

  /// Where the force of a closed contact stands in x; empty for an open one, and for one whose force is that of
  /// another.
  virtual std::optional<Index> multiplier_index(const Piece&, Index) const { return std::nullopt; }

  /// The value in x of a contact force whose guard is 1 [force].
  virtual double multiplier_scale() const { return 1.0; }

  /// The same point with the unknowns of a piece of the same layout where other contacts are closed: forces that are
  /// new are zero. Directions are transferred likewise.
  virtual Vector transfer(const Vector& x, const Piece& /*from*/, const Piece& /*to*/) const { return x; }

  /// Whether a piece holds motions that nothing resists to the second order, so that the second variation does not say
  /// how many directions are unstable. What eigenvalues count there are the others.
  virtual bool leaves_stability_open(const Piece&) const { return false; }

  /// Where the equations do not hold at this state although it may solve them: a closed contact beyond the end of its
  /// wall, in words for messages. Empty if they hold everywhere.
  virtual std::optional<std::string> invalid_place(const State&) const { return std::nullopt; }

  /// The same point on another piece of the same layout.
  State with_piece(const State& state, const Piece& piece) const {
    return {.x = transfer(state.x, state.piece, piece), .lambda = state.lambda, .piece = piece};
  }
};

/// Contacts among the guards of a piece whose gap and force both vanish within `tolerance`.
inline std::vector<Index> degenerate_contacts(const Vector& guards, const Piece& piece, double tolerance) {
  std::vector<Index> weak;
  for (Index j = 0; j < static_cast<Index>(piece.size()); ++j)
    if (std::abs(guards[j]) <= tolerance) weak.push_back(j);
  return weak;
}

}  // namespace arcwall
