#pragma once

#include "core/types.hpp"

namespace arcwall {

/// The cubic between two ends that has their places r1, r2 and tangents: over the chord c = r2 − r1 and its direction
/// β, at a fraction ξ of it,
///
///     r(ξ) = r1 + ξ c + c⊥ (N1 (θ1 − β) + N2 (θ2 − β)),   N1 = ξ (1 − ξ)², N2 = −ξ² (1 − ξ)
///
/// Angles against the chord are taken to within half a turn.
class CubicAxis {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// A place, and its derivatives by (x1, z1, angle1, x2, z2, angle2).
  struct Place {
    Vec2 position = Vec2::Zero();
    Eigen::Matrix<double, 2, 6> gradient = Eigen::Matrix<double, 2, 6>::Zero();
  };

  CubicAxis(const Vec2& r1, double angle1, const Vec2& r2, double angle2);

  Place at(double xi) const;

  /// Adds q·∂²r(ξ) by the same six.
  void add_second(double xi, const Vec2& q, Matrix6& to) const;

 private:
  Vec2 first_, chord_, across_;  // r1, c, c⊥
  double square_;                // |c|²
  double turn1_, turn2_;         // of the ends against the chord
};

}  // namespace arcwall
