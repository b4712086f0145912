#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "elements/element.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

/// Energy, gradient and (whole) Hessian of an element.
struct Evaluated {
  double energy;
  Vector f;
  Matrix K;
};

inline Evaluated evaluated(const Element& element, const Vector& u) {
  const Index n = element.unknown_count();
  Evaluated e{.energy = 0.0, .f = Vector::Zero(n), .K = Matrix::Constant(n, n, -12345.0)};
  e.energy = element.evaluate(u.data(), e.f.data(), e.K.data());
  e.K = Matrix(e.K.selfadjointView<Eigen::Lower>());
  return e;
}

/// f = ∂U and K = ∂f by central differences. `stiffness` is the greatest entry of K, `length` a length to which steps
/// are small. Truncation is 1e-12 of higher derivatives, round-off ε/1e-6: 1e-8 leaves room for both.
inline void expect_derivatives(const Element& element, const Vector& u) {
  constexpr double step = 1e-6, tolerance = 1e-8;
  const Evaluated at = evaluated(element, u);
  const double K_scale = std::max(at.K.cwiseAbs().maxCoeff(), 1e-300);
  const double f_scale = std::max(at.f.cwiseAbs().maxCoeff(), K_scale * std::max(1e-3, u.cwiseAbs().maxCoeff()));
  for (Index i = 0; i < u.size(); ++i) {
    Vector above = u, below = u;
    above[i] += step;
    below[i] -= step;
    const Evaluated a = evaluated(element, above), b = evaluated(element, below);
    EXPECT_NEAR((a.energy - b.energy) / (2.0 * step), at.f[i],
                tolerance * std::max(f_scale, std::abs(at.energy) + 1e-300))
        << "energy in unknown " << i;
    EXPECT_LE(((a.f - b.f) / (2.0 * step) - at.K.col(i)).cwiseAbs().maxCoeff(), tolerance * std::max(K_scale, f_scale))
        << "force in unknown " << i;
  }
  // Energy and force alone agree with all three together.
  Vector f(u.size());
  EXPECT_EQ(element.evaluate(u.data(), nullptr, nullptr), at.energy);
  EXPECT_EQ(element.evaluate(u.data(), f.data(), nullptr), at.energy);
  EXPECT_EQ(f, at.f);
}

/// The same by differences of order six with step 1e-3, each relative to its greatest entry: truncation h⁶/140 of
/// seventh derivatives, round-off ε/h.
inline void expect_derivatives_within(const Element& element, const Vector& u, double tolerance) {
  constexpr double step = 1e-3, weight[] = {45.0, -9.0, 1.0};
  const Evaluated at = evaluated(element, u);
  Vector f = Vector::Zero(u.size());
  Matrix K = Matrix::Zero(u.size(), u.size());
  for (Index i = 0; i < u.size(); ++i)
    for (const int k : {1, 2, 3}) {
      Vector above = u, below = u;
      above[i] += k * step;
      below[i] -= k * step;
      const Evaluated a = evaluated(element, above), b = evaluated(element, below);
      f[i] += weight[k - 1] * (a.energy - b.energy) / (60.0 * step);
      K.col(i) += weight[k - 1] * (a.f - b.f) / (60.0 * step);
    }
  EXPECT_LE((f - at.f).cwiseAbs().maxCoeff(), tolerance * at.f.cwiseAbs().maxCoeff());
  EXPECT_LE((K - at.K).cwiseAbs().maxCoeff(), tolerance * at.K.cwiseAbs().maxCoeff());
}

}  // namespace arcwall::test
