#pragma once

#include <string>

#include "core/algebra/factorization.hpp"
#include "core/system.hpp"

namespace arcwall {

/// How a descent ended.
enum class DescentEnd {
  at_rest,     ///< at a minimum of the potential
  falls_away,  ///< farther than structures go: nothing holds it
  not_found,   ///< it came to no rest
  cut_off,     ///< it took more work than it was given
};

struct Descent {
  DescentEnd end = DescentEnd::not_found;
  State state{};  ///< where it ended; at rest an equilibrium
  int steps = 0;
  bool meets_wall = false;  ///< on its way, between two contacts, where it cannot land
};

/// Overdamped motion of a structure at fixed λ among its obstacles, from a state that need be no equilibrium and whose
/// gaps are not negative (docs/theory.md, section 15):
///
///     μ W ẋ = −∂Π/∂x,    g_j ≥ 0
///
/// by implicit Euler, each step of which is a minimum of Π + ½ μ |x − xₙ|²_W among the obstacles, found by Newton's
/// method with an active set. μ, the inverse of the time step, is so large that each of these is convex and no step is
/// long. So Π falls from step to step. The unknowns mean the same all along: contacts are those of nodes.
///
/// A step that passes through an obstacle between the contacts is taken in parts, or not at all.
///
/// `factorizations`: that it may make; what is left of them when it ends.
Descent descend(const System& system, const State& start, const MakeFactorization& make, Index& factorizations);

/// Whether a structure that goes straight from one state to another at the same λ passes through an obstacle.
bool passes_a_wall(const System& system, const State& from, const State& to);

}  // namespace arcwall
