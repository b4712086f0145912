#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/state.hpp"

namespace arcwall {

/// How a contact with friction moves along both sides: it is held at the place w of the obstacle, and where contact
/// moves along the body at the material coordinate s. A length of the body that contact has passed is `stretch` times
/// that of its axis, so that it slips by dw − Λ ds. A material point slips by dw (FrictionalContact::rolls()).
struct ContactPlace {
  double w = 0.0;        ///< along the obstacle's tangent [length]
  double s = 0.0;        ///< in that sense [length]
  double stretch = 0.0;  ///< Λ, the mean of both sides [-]

  friend bool operator==(const ContactPlace&, const ContactPlace&) = default;
};

/// Contacts of a system, some of which have Coulomb friction, |T| ≤ μ p (UnilateralSystem::friction()).
///
/// Active sets then say what each contact does (mode()). The guards behind those of the contacts are the bounds of
/// sticking contacts, μ p − |T| ≥ 0. Slips end where slip_rate() vanishes.
class FrictionalContact {
 public:
  virtual ~FrictionalContact() = default;

  /// Returns true if contact j of an active set has friction where it is closed.
  virtual bool is_rough(const ActiveSet& active_set, Index j) const = 0;

  /// Returns true if active sets of a path may have other contacts: numbers of contacts then mean nothing on others.
  virtual bool contacts_move() const { return false; }

  /// Returns why friction of contact j is not modelled where it closes; empty if it is.
  virtual std::string why_not_modelled(const ActiveSet&, Index /*j*/) const { return {}; }

  /// Returns why friction is not modelled on an active set; empty if it is.
  virtual std::string why_not_modelled(const ActiveSet&) const { return {}; }

  /// Returns its coefficient of friction μ [-].
  virtual double coefficient(const ActiveSet& active_set, Index j) const = 0;

  /// Returns true if two contacts of an active set have friction and are of one point of the structure.
  virtual bool share_point(const ActiveSet& active_set, Index j, Index k) const = 0;

  /// Returns what a contact does on an active set.
  virtual ContactMode mode(const ActiveSet& active_set, Index j) const = 0;

  /// Returns the contacts that slip on an active set.
  virtual std::vector<Index> slipping(const ActiveSet& active_set) const = 0;

  /// Returns how fast a slipping contact slips in its own sense [length scale a unit of the direction]: ≥ 0 while the
  /// slip lasts.
  virtual double slip_rate(const State& state, const Direction& direction, Index j) const = 0;

  /// Returns the slip along the obstacle's tangent a unit of a direction, as a row; 0 of what does not slip [length].
  virtual Row slip_gradient(const State& state, Index j) const = 0;

  /// Returns how far a closed contact with friction has slipped along the obstacle since it closed [length].
  virtual double slip(const State& state, Index j) const = 0;

  /// Returns how far contact j of a state, which slips, has slipped since an event between which and the state contacts
  /// have parted, come together or moved to ends; 0 where they are the same [length].
  virtual double slip_since(const State& /*event*/, const State& /*state*/, Index /*j*/) const { return 0.0; }

  /// Returns true if contact j moves along the body, false if it is a node or an end of a member.
  virtual bool rolls(const ActiveSet&, Index /*j*/) const { return false; }

  /// Returns where a closed contact with friction is, and the rates along a direction.
  virtual ContactPlace place(const State& state, Index j) const = 0;
  virtual ContactPlace place_rates(const State& state, const Direction& direction, Index j) const = 0;

  /// Return the indices in x of the contact force p and of the friction force T of a contact; empty of others than
  /// closed ones with friction.
  virtual std::optional<Index> force_index(const ActiveSet& active_set, Index j) const = 0;
  virtual std::optional<Index> friction_index(const ActiveSet& active_set, Index j) const = 0;

  /// Returns the equation that holds the place of a contact that sticks, in F, and by how much its value changes a unit
  /// of slip along the obstacle's tangent.
  struct HeldPlace {
    Index equation = 0;
    double by_slip = 0.0;
  };
  virtual HeldPlace held_place(const ActiveSet& active_set, Index j) const = 0;

  /// Returns the friction force T of a contact along the obstacle's tangent, on the structure [force].
  virtual double friction_force(const State& state, Index j) const = 0;

  /// Returns the contact that reaches a bound of friction, and what it does beyond. Empty for other guards.
  virtual std::optional<ModeOfContact> beyond_friction_bound(const ActiveSet& active_set, Index guard) const = 0;

  /// Returns the same equilibrium with contacts in other modes. A contact that begins to stick is held where it is.
  virtual State with_modes(const State& state, std::span<const ModeOfContact> modes) const = 0;
};

}  // namespace arcwall
