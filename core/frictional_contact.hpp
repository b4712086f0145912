#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/state.hpp"

namespace arcwall {

/// Contacts of a system, some of which have Coulomb friction, |T| ≤ μ p (UnilateralSystem::friction()).
///
/// Active sets then say what each contact does (mode()). The guards behind those of the contacts are the bounds of
/// sticking contacts, μ p − |T| ≥ 0. Slips end where slip_rate() vanishes.
class FrictionalContact {
 public:
  virtual ~FrictionalContact() = default;

  /// Returns true if contact j has friction where it is closed.
  virtual bool is_rough(Index j) const = 0;

  /// Returns true if two contacts with friction are of one point of the structure.
  virtual bool share_point(Index j, Index k) const = 0;

  /// Returns what a contact does on an active set.
  virtual ContactMode mode(const ActiveSet& active_set, Index j) const = 0;

  /// Returns the contacts that slip on an active set.
  virtual std::vector<Index> slipping(const ActiveSet& active_set) const = 0;

  /// Returns how fast a slipping contact slips in its own sense [length scale a unit of the direction]: ≥ 0 while the
  /// slip lasts.
  virtual double slip_rate(const State& state, const Direction& direction, Index j) const = 0;

  /// Returns the friction force T of a contact along the obstacle's tangent, on the structure [force].
  virtual double friction_force(const State& state, Index j) const = 0;

  /// Returns the contact that reaches a bound of friction, and what it does beyond. Empty for other guards.
  virtual std::optional<ModeOfContact> beyond_friction_bound(const ActiveSet& active_set, Index guard) const = 0;

  /// Returns the same equilibrium with contacts in other modes. A contact that begins to stick is held where it is.
  virtual State with_modes(const State& state, std::span<const ModeOfContact> modes) const = 0;
};

}  // namespace arcwall
