#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/observable.hpp"
#include "core/state.hpp"

namespace arcwall {

/// The equations F(x, λ) = 0 at one state, with their derivatives. Reused from state to state: while the piece stays
/// the same, the pattern of K does, and only values are written.
///
/// ∂F/∂x is symmetric but for a border of a few unknowns s that stand last in x, with as many last equations. Each s_k
/// belongs to an unknown y_k of K (a moment that holds the body where it slides), which its equation may ask to vanish:
///
///     ∂F/∂x = [ K  B ]
///             [   C  ]
struct Linearization {
  Vector F{};                              ///< residual, internal minus external
  SparseMatrix K{};                        ///< the symmetric part: its lower triangle alone is stored
  Matrix B{};                              ///< columns of the border; none for most systems
  LongRows C{};                            ///< rows of the border, by x and s
  std::vector<Index> holding{};            ///< y_k, one a column of B
  Vector F_lambda{};                       ///< ∂F/∂λ
  std::vector<bool> translation_free{};    ///< nodes on which no force arises where everything moves parallel, by
                                           ///< unknowns of K: true for the displacement in x of such a node, behind
                                           ///< which stands that in z. Solutions then know this to the last digit,
                                           ///< which K's rounded entries do not. May be empty
  std::optional<Piece> pattern_of{};       ///< the piece whose pattern K has; empty: not laid out yet
  std::unique_ptr<Linearization> inner{};  ///< workspace of a system that wraps another
};

/// What the equilibria of a continuum have in common.
struct Continuum {
  double energy = 0.0;  ///< total potential [force·length]
  double length = 0.0;  ///< sum of the lengths of the body's flat parts on walls, new ones being points yet [length]
};

/// What lies behind a limit of a piece: another piece that meets it there.
struct Transition {
  enum class Change {
    spreads,      ///< a point contact becomes a line
    gathers,      ///< a line becomes a point contact; the place is known on the piece ahead alone
    splits,       ///< a part on a wall lifts off inside
    joins,        ///< the reverse; the place is known on the piece ahead alone
    remeshed,     ///< the same point in other unknowns
    continuum,    ///< a continuum of equilibria with the same load and energy
    unsupported,  ///< something that is not modelled
  };
  Change change = Change::remeshed;
  std::string detail{};  ///< of the last two: what and why
  std::optional<Continuum> continuum{};
  std::vector<Index> contacts{};  ///< that change: in the piece behind, of `gathers` and `joins` in the piece ahead
  State guess{};                  ///< on the piece ahead, near the first point there
  Direction forward{};            ///< there, roughly
  /// Has `value` at the first point of the piece ahead and grows along it. Null: the first point lies in the plane
  /// through the guess across `forward`.
  std::shared_ptr<const Observable> quantity{};
  double value = 0.0;
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

  /// No contact closed, unknowns as a path from rest begins with.
  virtual Piece open_piece() const { return {}; }

  /// How many unknowns at the end of those of K are contact forces and moments.
  virtual Index multiplier_count(const Piece&) const { return 0; }

  /// How many unknowns stand behind those of K: columns of Linearization::B.
  virtual Index border_width(const Piece&) const { return 0; }

  /// The rates by s_k of the equations that the y_k enforce, if the body slid there and the y_k did not hold it; 0
  /// where it is truly held. Stability is counted with the others let go (ReleasedBorder).
  virtual Vector border_rates(const State& state) const { return Vector::Zero(border_width(state.piece)); }

  // --- guards: side conditions that say how far a piece reaches -------------------------------------------------

  /// Guards of a piece: one a contact, as many as the piece has entries, then those that bound the piece otherwise
  /// (its limits: see transition()).
  virtual Index guard_count(const Piece& piece) const { return static_cast<Index>(piece.size()); }

  /// Scaled to order 1 and ≥ 0 on this piece: the gap of an open contact, the force of a closed one. A guard that
  /// cannot be reached is large.
  virtual Vector guards(const State&) const { return {}; }

  /// Guard j alone.
  virtual double guard(const State& state, Index j) const { return guards(state)[j]; }

  /// Derivative of guard j, scaled likewise.
  virtual Row guard_gradient(const State& state, Index) const {
    return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  }

  /// Derivatives of all guards along a direction.
  virtual Vector guard_rates(const State& state, const Direction& direction) const {
    Vector rates(guard_count(state.piece));
    for (Index j = 0; j < rates.size(); ++j) rates[j] = apply(guard_gradient(state, j), direction);
    return rates;
  }

  /// −∂F/∂p_j, the unit response of contact j, for a state on a piece where j is open; scaled so that it belongs to a
  /// change of 1 of the guard `force of j`.
  virtual Vector unit_force(const State& state, Index) const { return Vector::Zero(state.x.size()); }

  /// How far a closed contact gives way for its force, both in the scale of the guards: its gap is −compliance times
  /// its force. Zero for rigid obstacles.
  virtual double compliance(Index) const { return 0.0; }

  /// Where the force of a closed contact stands in x; empty for an open one.
  virtual std::optional<Index> multiplier_index(const Piece&, Index) const { return std::nullopt; }

  /// The value in x of a multiplier whose guard is 1.
  virtual double multiplier_scale() const { return 1.0; }

  /// The same point with the unknowns of another piece: forces that are new are zero.
  virtual Vector transfer(const Vector& x, const Piece&, const Piece&) const { return x; }

  /// What may lie behind a limit that was reached going `forward`, the likeliest first: the first that leads to a point
  /// whose guards hold is taken. Limits within `tolerance` of zero are reached together.
  virtual std::vector<Transition> transitions(const State&, const Direction& /*forward*/, Index /*limit*/,
                                              double /*tolerance*/) const {
    return {};
  }

  /// Whether side conditions that are no guards of this piece exceed `margin`, in the scale of the guards: nothing
  /// enters an obstacle between the contacts.
  virtual bool admissible(const State&, double /*margin*/) const { return true; }

  /// The transition (`remeshed`) from a regular point to a piece whose guards see what is below `margin` at `to`, the
  /// end of a step; empty if no such piece passes through `from`. Asked for where admissible(to, margin) is not so.
  virtual std::optional<Transition> with_inserted_contact(const State& /*from*/, const Direction& /*forward*/,
                                                          const State& /*to*/, double /*margin*/) const {
    return std::nullopt;
  }

  /// The piece whose guards suit a state that was reached along another branch: a flat part that has buckled, say.
  virtual Piece canonical_piece(const State& state) const { return state.piece; }

  /// Why the equations do not hold at this state although it may solve them (a wall that ends); empty if they do.
  virtual std::optional<std::string> invalid_reason(const State&) const { return std::nullopt; }

  /// The same point on another piece.
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
