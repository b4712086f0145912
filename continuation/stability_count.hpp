#pragma once

#include <optional>

#include "core/types.hpp"

namespace arcwall {

/// Stability of an equilibrium under load control, by the second variation.
enum class Stability { stable, unstable, undecided };

/// Stores the number of negative eigenvalues of K on {v : G_S v = 0}. S: the closed contacts with a force above the
/// tolerance. Closed contacts without force do not constrain v.
struct StabilityCount {
  std::optional<Index> unstable{};  ///< empty: K is singular to round-off, or the second variation is indeterminate
  Stability stability = Stability::undecided;
};

}  // namespace arcwall
