#pragma once

#include <array>
#include <cassert>
#include <cmath>

namespace arcwall {

/// Lagrange's polynomials and their derivatives at one ξ; nodes at ξ = −1, 1 (order 1) or −1, 0, 1 (order 2).
struct ShapeFunctions {
  std::array<double, 3> N{}, dN{};
};

inline ShapeFunctions shape_functions(int order, double xi) {
  assert(order == 1 || order == 2);
  if (order == 1) return {.N = {0.5 * (1.0 - xi), 0.5 * (1.0 + xi)}, .dN = {-0.5, 0.5}};
  return {.N = {0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)}, .dN = {xi - 0.5, -2.0 * xi, xi + 0.5}};
}

/// Gauss's rule over −1 ≤ ξ ≤ 1.
struct GaussRule {
  std::array<double, 3> xi{}, weight{};  ///< the first `points`
};

inline GaussRule gauss_rule(int points) {
  assert(points >= 1 && points <= 3);
  if (points == 1) return {.xi = {0.0}, .weight = {2.0}};
  if (points == 2) return {.xi = {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}, .weight = {1.0, 1.0}};
  return {.xi = {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, .weight = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
}

}  // namespace arcwall
