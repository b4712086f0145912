#pragma once

#include <limits>

#include "core/system.hpp"

namespace arcwall {

/// r = f − J δx − F_λ δλ of a solution, and the sum of the magnitudes of its terms: below some ε of them r is
/// round-off, and no other solution is better. On a fine mesh stiffness times displacement is large beside f.
struct BorderedResidual {
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

  Vector r{}, terms{};

  bool is_small(const Vector& f) const;
};

BorderedResidual residual_of(const Linearization& equations, const Vector& f, const Direction& solution);

}  // namespace arcwall
