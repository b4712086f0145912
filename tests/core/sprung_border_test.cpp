#include "core/sprung_border.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/ldlt.hpp"
#include "core/near_null.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::sprung_border_test {

namespace {

constexpr Index n = 14, m = 3;

// A body of n unknowns and three motions h_k of it that multipliers y_k hold: K = [A H; Hᵀ 0].
struct Held {
  Matrix A, H;
  SparseMatrix K;
  Ldlt ldlt;
  std::vector<Index> holding;

  explicit Held(test::Numbers& numbers) : A(numbers.matrix(n, n)), H(numbers.matrix(n, m)) {
    A = (0.1 * (A + A.transpose())).eval();
    for (Index i = 0; i < n; ++i) A(i, i) += i < 3 ? 0.2 * double(i - 1) : (i % 2 == 0 ? 6.0 : -9.0);  // few near zero
    Matrix whole = Matrix::Zero(n + m, n + m);
    whole.topLeftCorner(n, n) = A;
    whole.bottomLeftCorner(m, n) = H.transpose();
    whole.topRightCorner(n, m) = H;
    K = test::lower_triangle(whole);
    for (Index k = 0; k < m; ++k) holding.push_back(n + k);
    ldlt.set_multiplier_count(m);
    EXPECT_EQ(ldlt.factorize(K), FactorStatus::ok);
  }

  // A + Σ c_k h_k h_kᵀ on the motions that infinite c_k leave free.
  Matrix sprung(const Vector& springs) const {
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

TEST(SprungBorder, CountsAndFindsThePairsOfTheSprungBody) {
  test::Numbers numbers(41);
  for (int round = 0; round < 20; ++round) {
    const Held body(numbers);
    Vector weights = Vector::Ones(n + m);
    weights.tail(m).setZero();
    for (const Vector& springs : some_springs()) {
      const SprungBorder border(body.ldlt, body.K, body.holding, springs);
      ASSERT_TRUE(border.is_finite());
      Vector exact = Eigen::SelfAdjointEigenSolver<Matrix>(body.sprung(springs)).eigenvalues();
      EXPECT_EQ(body.ldlt.inertia()->negative - m + border.negative(), (exact.array() < 0.0).count());
      std::sort(exact.begin(), exact.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
      const NearNull found = near_null(border, weights, 2);
      ASSERT_EQ(found.values.size(), 2);
      for (Index i = 0; i < 2; ++i) EXPECT_NEAR(found.values[i], exact[i], 1e-9);
    }
  }
}

TEST(SprungBorder, SolvesWithTheMomentsOfTheSprings) {
  test::Numbers numbers(42);
  const Held body(numbers);
  const Vector springs{{0.7, 0.0, 0.1}};
  const SprungBorder border(body.ldlt, body.K, body.holding, springs);
  Matrix right = Matrix::Zero(n + m, 2);
  right.topRows(n) = numbers.matrix(n, 2);
  Matrix X = right;
  border.solve(X);
  EXPECT_LE((body.sprung(springs) * X.topRows(n) - right.topRows(n)).norm(), 1e-10);
  EXPECT_LE((X.bottomRows(m) - springs.asDiagonal() * body.H.transpose() * X.topRows(n)).norm(), 1e-10);
  EXPECT_LE((border.product(X) - right).norm(), 1e-10);
}

}  // namespace arcwall::sprung_border_test
