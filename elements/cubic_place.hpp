#pragma once

#include <array>

#include "core/types.hpp"

namespace arcwall {

/// A place ξ of the cubic between two ends, with its derivatives by (x1, z1, angle1, x2, z2, angle2): over the chord c
/// and its direction β,
///
///     r1 + ξ c + c⊥ (N1 (θ1 − β) + N2 (θ2 − β)),   N1 = ξ (1 − ξ)², N2 = −ξ² (1 − ξ)
struct CubicPlace {
  Vec2 position = Vec2::Zero();
  Eigen::Matrix<double, 2, 6> gradient = Eigen::Matrix<double, 2, 6>::Zero();
  std::array<Eigen::Matrix<double, 6, 6>, 2> second{};  ///< of x and of z
};

/// `ends`: x, z and angle of the first end and of the second; 0 ≤ ξ ≤ 1.
CubicPlace cubic_place(const Eigen::Matrix<double, 6, 1>& ends, double xi);

}  // namespace arcwall
