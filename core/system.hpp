#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/transition.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// The third of three levels, and what a path is traced of: a system whose unknowns may change along the path.
///
///     Equations            F(x, λ) = 0, smooth on a piece              four functions must be overridden
///     ← UnilateralSystem   gaps and contact forces, g ≥ 0 and p ≥ 0    six more, by a system with contacts
///     ← System             other unknowns behind validity bounds       six more, by a system that remeshes
///
/// Contacts do not change what the unknowns mean; a *layout* (Piece::layout()) does: a mesh whose nodes follow contact
/// points, say. A layout serves up to its *validity bounds*, guards behind those of the contacts: they are positive on
/// the piece, landed on like the others, and behind each of them lies another layout.
///
/// Nothing must be overridden by a system whose unknowns always mean the same. One whose do: transitions and, of the
/// second level, guard_count; admissible together with with_inserted_contact where contacts come into being between
/// those that a piece has, and with_mesh_for_landing where their places choose the mesh; passes_through where obstacles
/// have more sides than one; canonical_piece where two layouts share equilibria. Must hold: the first point of a piece
/// ahead is an equilibrium on which all guards there hold, and the same point as the one behind but for discretisation.
class System : public UnilateralSystem {
 public:
  /// What may lie behind a validity bound that was reached going `forward`, the likeliest first: the first that leads
  /// to a point whose guards hold is taken. `bound` is its number among the guards. Bounds within `tolerance` of zero
  /// are reached together.
  virtual std::vector<Transition> transitions(const State&, const Direction& /*forward*/, Index /*bound*/,
                                              double /*tolerance*/) const {
    return {};
  }

  /// Whether side conditions that are no guards of this piece exceed `margin`, in the scale of the guards: nothing
  /// enters an obstacle between the contacts.
  virtual bool admissible(const State&, double /*margin*/) const { return true; }

  /// Names what exceeds `margin` most, for messages: `floor at beam:0.4`; empty where nothing does.
  virtual std::string most_inadmissible(const State&, double /*margin*/) const { return {}; }

  /// The transition (`remeshed`) from a regular point to a piece whose guards see what is below `margin` at `to`, the
  /// end of a step; empty if no such piece passes through `from`. Asked for where admissible(to, margin) is not so.
  virtual std::optional<Transition> with_inserted_contact(const State& /*from*/, const Direction& /*forward*/,
                                                          const State& /*to*/, double /*margin*/) const {
    return std::nullopt;
  }

  /// The transition (`remeshed`) from a regular point to a piece whose mesh suits a guard that was landed on at `to`,
  /// the end of a step, as it would have been chosen by one who knew the place; empty if the piece of `from` is that.
  virtual std::optional<Transition> with_mesh_for_landing(const State& /*from*/, const Direction& /*forward*/,
                                                          const State& /*to*/, Index /*guard*/) const {
    return std::nullopt;
  }

  /// Whether the body would have to go through an obstacle on its way from one state to the other, a landed end of a
  /// step: it is inside there, or on another side.
  virtual bool passes_through(const State& /*from*/, const State& /*to*/) const { return false; }

  /// Whether the path from one state to another on the same piece may have a kink: a closed contact goes over a place
  /// where the curvature of its obstacle jumps, as where the arc of a rounded corner begins.
  virtual bool may_have_kink(const State& /*from*/, const State& /*to*/) const { return false; }

  /// Whether the body comes from beyond the end of an obstacle to where it is inside of it, through where the obstacle
  /// has no face: that of an upper arc of a circle from below, say.
  virtual bool comes_behind_an_end(const State& /*from*/, const State& /*to*/) const { return false; }

  /// How many separate contacts a piece has: of those that are closed, the ones of one contact zone count as one.
  virtual Index separate_contacts(const Piece& piece) const {
    Index closed = 0;
    for (std::size_t k = 0; k < piece.contacts(); ++k) closed += piece[k] != 0 ? 1 : 0;
    return closed;
  }

  /// The piece whose guards suit a state that was reached along another branch: a flat part that has buckled, say.
  virtual Piece canonical_piece(const State& state) const { return state.piece; }
};

}  // namespace arcwall
