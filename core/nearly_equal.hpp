#pragma once

#include <cmath>

namespace arcwall {

/// Relative difference of λ and energy between states that differ by round-off: mirror images, and states between which
/// nothing has moved.
inline constexpr double same_value = 1e-9;

inline bool equal_within(double relative, double a, double b) {
  return std::abs(a - b) <= relative * (std::abs(a) + std::abs(b));
}

inline bool nearly_equal(double a, double b) { return equal_within(same_value, a, b); }

}  // namespace arcwall
