#pragma once

#include <optional>

#include "core/types.hpp"

namespace arcwall {

/// What the second variation says of an equilibrium under load control.
enum class Stability { stable, unstable, undecided };

/// Negative eigenvalues of K on {v : G_S v = 0}, S the contacts that are closed with a force above the tolerance, and
/// what follows from it. Contacts without force hold nothing (Selke & Kikuchi's snap would be hidden if they did).
struct StabilityCount {
  std::optional<Index> unstable{};  ///< empty: K is singular within round-off, or the second variation leaves it open
  Stability stability = Stability::undecided;
};

}  // namespace arcwall
