#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace arcwall {

/// What a contact does along an obstacle with Coulomb friction, |T| ≤ μ p.
enum class ContactMode : std::uint8_t {
  open,
  closed,          ///< without friction
  sticks,          ///< it holds its place on the obstacle, |T| ≤ μ p
  slips_forward,   ///< along the obstacle's tangent, T = −μ p
  slips_backward,  ///< against it, T = μ p
};

constexpr bool slips(ContactMode mode) {
  return mode == ContactMode::slips_forward || mode == ContactMode::slips_backward;
}

/// The sense of a slip along the obstacle's tangent, 1 or −1; 0 of what does not slip.
constexpr double slip_sense(ContactMode mode) {
  return mode == ContactMode::slips_forward ? 1.0 : mode == ContactMode::slips_backward ? -1.0 : 0.0;
}

/// A contact, and what it does.
struct ModeOfContact {
  Index contact = 0;
  ContactMode mode = ContactMode::open;

  friend bool operator==(const ModeOfContact&, const ModeOfContact&) = default;
};

}  // namespace arcwall
