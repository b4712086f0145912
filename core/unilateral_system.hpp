#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/equations.hpp"
#include "core/frictional_contact.hpp"
#include "core/path_history.hpp"

namespace arcwall {

/// Stores the values of all guards at a state and their derivatives along a direction.
struct GuardsAlong {
  Vector values{}, rates{};
};

/// How a contact is enforced.
struct Enforcement {
  std::optional<Index> multiplier{};  ///< of its force in x; empty: it is open, or shares the force of another contact
  double force_scale = 1.0;           ///< value in x of its force whose guard is 1 [force]
  double compliance = 0.0;            ///< gap = −compliance · force [scale of guards]; 0 if rigid
  bool two_sided = false;             ///< closed for either sign of its force: its guard never vanishes
};

/// The parts of a system by which equilibria depend on the path to them.
struct PathDependence {
  const FrictionalContact* friction = nullptr;  ///< of the contacts; null if none has friction
  const PathHistory* history = nullptr;         ///< internal variables of the equations; null if they have none
};

/// Adds unilateral constraints to the equations: the second of three levels of a system.
///
/// An ActiveSet has one entry a contact. Contact j is open (gap g_j ≥ 0, force 0) or closed (gap 0, force p_j ≥ 0, an
/// unknown). Its *guard* is the inequality constraint that must stay ≥ 0: the gap if open, the force if closed, scaled
/// to order 1. The active set changes where a guard vanishes.
///
/// A kink of a piecewise linear law is a compliant contact: its gap is the deformation left up to the kink, its force
/// the deformation beyond it, its compliance 1. It has no multiplier.
///
/// A system with contacts overrides open_active_set, guards, guard_gradient, unit_force, enforcement and transfer, and
/// counts its multipliers in dimensions(). guard_gradient() is the derivative of guards(); guard() and guards_along()
/// agree with both. A force enters F by the gradient of its gap, so K stays symmetric. transfer() there and back
/// returns the same x if the omitted forces are zero.
class UnilateralSystem : public Equations {
 public:
  /// Returns the active set with all contacts open and the initial layout.
  virtual ActiveSet open_active_set() const { return {}; }

  /// Returns all guards [-]: those of the contacts, then the validity bounds (see System). A guard that cannot vanish
  /// is large.
  virtual Vector guards(const State&) const { return {}; }

  /// Returns guard j alone [-].
  virtual double guard(const State& state, Index j) const { return guards(state)[j]; }

  /// Returns the derivative of guard j by (x, λ).
  virtual Row guard_gradient(const State& state, Index) const {
    return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  }

  /// Returns all guards and their derivatives along a direction.
  virtual GuardsAlong guards_along(const State& state, const Direction& direction) const {
    GuardsAlong along{.values = guards(state), .rates = Vector(guard_count(state.active_set))};
    for (Index j = 0; j < along.rates.size(); ++j) along.rates[j] = apply(guard_gradient(state, j), direction);
    return along;
  }

  /// Returns the obstacle and the location of guard j, for messages. May be empty.
  virtual std::string watched_place(const State&, Index /*j*/) const { return {}; }

  /// Returns −∂F/∂p_j of the open contact j, size(state.active_set) entries. p_j is scaled as the guard of the closed
  /// contact.
  virtual Vector unit_force(const State& state, Index) const { return Vector::Zero(state.x.size()); }

  /// Returns how contact j is enforced on an active set.
  virtual Enforcement enforcement(const ActiveSet&, Index /*j*/) const { return {}; }

  /// Returns x for another active set of the same layout; new contact forces are zero. Also valid for directions.
  virtual Vector transfer(const Vector& x, const ActiveSet& /*from*/, const ActiveSet& /*to*/) const { return x; }

  /// Returns the parts that depend on the path: none by default.
  virtual PathDependence path_dependence() const { return {}; }

  /// Returns the number of guards.
  Index guard_count(const ActiveSet& active_set) const {
    return static_cast<Index>(active_set.size()) + dimensions(active_set).bounds;
  }

  const FrictionalContact* friction() const { return path_dependence().friction; }
  const PathHistory* history() const { return path_dependence().history; }
  bool has_friction() const { return friction() != nullptr; }

  /// Returns the contacts that slip on an active set.
  std::vector<Index> slipping(const ActiveSet& active_set) const {
    return has_friction() ? friction()->slipping(active_set) : std::vector<Index>{};
  }

  /// Returns the same state with another active set of the same layout.
  State with_active_set(const State& state, const ActiveSet& active_set) const {
    return {.x = transfer(state.x, state.active_set, active_set), .lambda = state.lambda, .active_set = active_set};
  }
};

/// Returns the contacts whose gap and force both vanish within `tolerance` [scale of guards].
inline std::vector<Index> degenerate_contacts(const Vector& guards, const ActiveSet& active_set, double tolerance) {
  std::vector<Index> weak;
  for (Index j = 0; j < static_cast<Index>(active_set.size()); ++j)
    if (std::abs(guards[j]) <= tolerance) weak.push_back(j);
  return weak;
}

}  // namespace arcwall
