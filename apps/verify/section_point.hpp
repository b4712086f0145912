#pragma once

#include <cmath>

#include "core/types.hpp"

namespace arcwall::verify {

/// A point of a section at a node: r + o d + o² q with d = (1 + e) t, t the stress-free normal turned by φ, and q = ξ t
/// or ξ n, n the normal of the axis without imperfection (Selke and Kikuchi's eq. 15). e = ξ = 0 elsewhere.
struct SectionPoint {
  Vec2 node = Vec2::Zero();                    ///< stress-free [length]
  double shape_angle = 0.0, axis_angle = 0.0;  ///< with and without imperfection [rad]
  double offset = 0.0;                         ///< o [length]
  bool along_director = false;                 ///< q = ξ t

  /// Where the node's unknowns are u: displacements, and perhaps φ, e and ξ.
  Vec2 at(const Vector& u) const {
    const auto normal = [](double angle) { return Vec2(-std::sin(angle), std::cos(angle)); };
    const double turned = u.size() > 2 ? u[2] : 0.0, e = u.size() > 3 ? u[3] : 0.0, xi = u.size() > 4 ? u[4] : 0.0;
    const Vec2 t = normal(shape_angle + turned);
    return node + u.head<2>() + offset * (1.0 + e) * t +
           offset * offset * xi * (along_director ? t : normal(axis_angle));
  }
};

}  // namespace arcwall::verify
