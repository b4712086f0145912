#include "core/algebra/sliding_stability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/algebra/bordered_solver.hpp"
#include "core/algebra/near_null.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::sliding_stability_test {

namespace {

constexpr Index n = 14, m = 3;

// A body of n unknowns u and three motions h_kᵀ u of it that multipliers y_k hold: K = [A H; Hᵀ 0]. Where it slides by
// s_k the motion changes by w_k s_k and a force −c_k w_k s_k h_k is left: with y_k = 0, a spring c_k on h_k. A motion
// whose c_k is infinite is truly held, and its s_k says something of the body that has no effect.
struct Held {
  Matrix A, H;
  Vector springs, rates;
  Linearization now;
  BorderedSolver solver;

  Held(test::Numbers& numbers, const Vector& c)
      : A(numbers.matrix(n, n)), H(numbers.matrix(n, m)), springs(c), rates{{1.5, -0.4, 2.0}} {
    A = (0.1 * (A + A.transpose())).eval();
    for (Index i = 0; i < n; ++i) A(i, i) += i < 3 ? 0.2 * double(i - 1) : (i % 2 == 0 ? 6.0 : -9.0);  // few near zero
    Matrix whole = Matrix::Zero(n + m, n + m);
    whole.topLeftCorner(n, n) = A;
    whole.bottomLeftCorner(m, n) = H.transpose();
    whole.topRightCorner(n, m) = H;
    now.K = test::lower_triangle(whole);
    now.B.setZero(n + m, m);
    now.C.setZero(m, n + 2 * m);
    for (Index k = 0; k < m; ++k) {
      now.holding.push_back(n + k);
      if (std::isfinite(c[k])) {
        now.B.col(k).head(n) = -c[k] * rates[k] * H.col(k);
        now.B(n + k, k) = rates[k];
        now.C(k, n + k) = 1.0;
      } else {
        now.C.row(k).head(n) = numbers.matrix(1, n);
        now.C(k, n + m + k) = 0.8;
        rates[k] = 0.0;
      }
    }
    now.border_rates = rates;
    now.F = Vector::Zero(n + 2 * m);
    EXPECT_EQ(solver.factorize(now, m), FactorStatus::ok);
  }

  SlidingResistance resistance() const { return sliding_resistance(solver, now); }

  // A + Σ c_k h_k h_kᵀ on the motions that infinite c_k leave free.
  Matrix sprung() const {
    Matrix stiffness = A, held(n, 0);
    for (Index k = 0; k < m; ++k) {
      if (std::isfinite(springs[k])) {
        stiffness += springs[k] * H.col(k) * H.col(k).transpose();
      } else {
        held.conservativeResize(n, held.cols() + 1);
        held.rightCols(1) = H.col(k);
      }
    }
    if (held.cols() == 0) return stiffness;
    const Matrix Q = held.householderQr().householderQ();
    const Matrix free = Q.rightCols(n - held.cols());
    return free.transpose() * stiffness * free;
  }
};

std::vector<Vector> some_springs() {
  return {Vector{{0.0, 0.0, 0.0}}, Vector{{0.7, 2.0, 0.1}}, Vector{{infinity, 0.3, 0.0}},
          Vector{{infinity, infinity, infinity}}};
}

}  // namespace

TEST(SlidingStabilityOperator, CountsAndFindsThePairsOfTheBodyThatSlides) {
  test::Numbers numbers(41);
  for (int round = 0; round < 20; ++round)
    for (const Vector& springs : some_springs()) {
      const Held body(numbers, springs);
      Vector weights = Vector::Ones(n + m);
      weights.tail(m).setZero();
      Vector exact = Eigen::SelfAdjointEigenSolver<Matrix>(body.sprung()).eigenvalues();
      const Index held = body.solver.inner().inertia()->negative - m;
      EXPECT_EQ(held + body.resistance().negative().value(), (exact.array() < 0.0).count());
      const SlidingStabilityOperator border(body.solver, body.now, body.resistance());
      ASSERT_TRUE(border.is_finite());
      std::sort(exact.begin(), exact.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
      const NearNull found = near_null(border, weights, 2);
      ASSERT_EQ(found.values.size(), 2);
      for (Index i = 0; i < 2; ++i) EXPECT_NEAR(found.values[i], exact[i], 1e-9);
    }
}

TEST(SlidingStabilityOperator, SolvesWithTheMomentsOfTheSprings) {
  test::Numbers numbers(42);
  const Held body(numbers, Vector{{0.7, 0.0, 0.1}});
  const SlidingStabilityOperator border(body.solver, body.now, body.resistance());
  Matrix right = Matrix::Zero(n + m, 2);
  right.topRows(n) = numbers.matrix(n, 2);
  Matrix X = right;
  border.solve(X);
  EXPECT_LE((body.sprung() * X.topRows(n) - right.topRows(n)).norm(), 1e-10);
  EXPECT_LE((X.bottomRows(m) - body.springs.asDiagonal() * body.H.transpose() * X.topRows(n)).norm(), 1e-10);
  EXPECT_LE((border.product(X) - right).norm(), 1e-10);
}

// Whatever the border: with one motion let go and another held, det ∂F/∂x = −det K D_hh w T.
TEST(SlidingStabilityOperator, IsSingularWhereTheEquationsAre) {
  test::Numbers numbers(43);
  for (int round = 0; round < 20; ++round) {
    Linearization now;
    const Matrix K = numbers.matrix(n, n), symmetric = K + K.transpose();
    now.K = test::lower_triangle(symmetric);
    now.B = numbers.matrix(n, 2);
    now.C = numbers.matrix(2, n + 2);
    now.holding = {n - 2, n - 1};
    now.F = Vector::Zero(n + 2);
    BorderedSolver solver;
    ASSERT_EQ(solver.factorize(now, 0), FactorStatus::ok);
    const double w = -0.3;
    now.border_rates = Vector{{w, 0.0}};
    const double T = sliding_resistance(solver, now).T.value();
    Matrix J(n + 2, n + 2);
    J << symmetric, now.B, now.C;
    const double expected = J.determinant(), found = -symmetric.determinant() * solver.reduced()(1, 1) * w * T;
    EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected));
  }
}

}  // namespace arcwall::sliding_stability_test
