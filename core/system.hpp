#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/path_kink.hpp"
#include "core/step_verdict.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Adds layouts of the degrees of freedom that change along the path: the third of three levels, used by Tracer.
///
///     Equations            F(x, λ) = 0, smooth for an active set       override four functions
///     ← UnilateralSystem   gaps and contact forces, g ≥ 0 and p ≥ 0    six more for contacts
///     ← System             other unknowns beyond validity bounds       six more for remeshing
///
/// A *layout* (ActiveSet::layout()) defines the unknowns: for example a mesh that follows contact points. It is valid
/// up to its *validity bounds*. These are guards after those of the contacts: positive while the layout is valid, and
/// located as events. Another layout follows beyond each of them.
///
/// A system with one layout overrides nothing. Others override transitions, count their bounds in dimensions(),
/// and if needed override
/// - penetrated_place, if contacts can arise between those of an active set;
/// - check, to reject or repeat steps for what no guard sees; canonical_active_set, if two layouts share equilibria.
///
/// The first point with a new layout is an equilibrium with all guards ≥ 0. It equals the last point with the old
/// layout up to discretisation.
class System : public UnilateralSystem {
 public:
  /// Returns the possible layouts beyond a validity bound reached along `forward`, most likely first. The tracer takes
  /// the first one with a point whose guards are ≥ 0. `bound`: number of the guard; bounds within `tolerance` of zero
  /// are reached together. Empty if there is none.
  virtual std::vector<Transition> transitions(const State&, const Direction& /*forward*/, Index /*bound*/,
                                              double /*tolerance*/) const {
    return {};
  }

  /// Returns the verdict on a step: what no guard sees.
  virtual StepVerdict check(const CheckedStep&) const { return {}; }

  /// Returns the location of the smallest gap below `margin` [scale of guards] between the contacts; empty if there is
  /// none. The location may have no name.
  virtual std::optional<std::string> penetrated_place(const State&, double /*margin*/) const { return std::nullopt; }

  /// Returns the first kink that the path may have between two states with one active set: a closed contact passes a
  /// jump of the obstacle's curvature, for example the begin of a rounded corner. `to` need be no equilibrium.
  virtual std::optional<PathKink> kink_between(const State& /*from*/, const State& /*to*/) const {
    return std::nullopt;
  }

  /// Returns the number of separate closed contacts; those of one contact zone count as one.
  virtual Index separate_contacts(const ActiveSet& active_set) const {
    Index closed = 0;
    for (std::size_t k = 0; k < active_set.contacts(); ++k) closed += active_set[k] != 0 ? 1 : 0;
    return closed;
  }

  /// Returns the active set whose guards fit a state reached along another branch: for example a buckled contact zone.
  virtual ActiveSet canonical_active_set(const State& state) const { return state.active_set; }
};

}  // namespace arcwall
