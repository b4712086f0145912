#pragma once

#include <array>

#include "core/state.hpp"

namespace arcwall {

/// The states that satisfy the linearised equilibrium K δx + F_λ δλ = −F: a line, particular + τ · tangent. Both are
/// made of two solutions, which stay as they were found:
///
///     particular = column 0 − off · column 1,    tangent = scale · column 1
struct EquilibriumLine {
  Matrix dx{};                              ///< columns
  std::array<double, 2> dlambda{0.0, 1.0};  ///< of the columns
  double off = 0.0, scale = 1.0;

  double particular_dlambda() const { return dlambda[0] - off * dlambda[1]; }
  double tangent_dlambda() const { return scale * dlambda[1]; }
  Direction particular() const { return {.dx = dx.col(0) - off * dx.col(1), .dlambda = particular_dlambda()}; }
  Direction tangent() const { return {.dx = scale * dx.col(1), .dlambda = tangent_dlambda()}; }
};

/// Σ w_i a_i b_i of the columns of a line.
struct LineProducts {
  double pp, pt, tt;  ///< p: column 0, t: column 1
};

}  // namespace arcwall
