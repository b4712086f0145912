#include "core/algebra/near_null.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/algebra/ldlt.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::near_null_test {

namespace {

// Tridiagonal with diagonal `d` and −1 beside: eigenvalues d − 2 cos(kπ/(n+1)).
Matrix chain(Index n, double d) {
  Matrix K = d * Matrix::Identity(n, n);
  for (Index i = 0; i + 1 < n; ++i) K(i, i + 1) = K(i + 1, i) = -1.0;
  return K;
}

std::vector<double> chain_values(Index n, double d) {
  std::vector<double> values;
  for (Index k = 1; k <= n; ++k) values.push_back(d - 2.0 * std::cos(double(k) * pi / double(n + 1)));
  std::sort(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return values;
}

// Rayleigh-Ritz values are off by the square of what the vectors are off by; the search stops when values change by
// less than 1e-10 of the greatest of the block, which is below 1 here.
constexpr double tolerance = 1e-9;

}  // namespace

TEST(NearNull, FindsTheEigenvaluesNearestZeroOfDefiniteAndIndefiniteChains) {
  for (const double d : {2.0, 0.35, -0.8}) {
    SCOPED_TRACE(d);
    constexpr Index n = 30;
    const SparseMatrix K = test::lower_triangle(chain(n, d));
    Ldlt ldlt;
    ASSERT_EQ(ldlt.factorize(K), FactorStatus::ok);
    const NearNull found = near_null(ldlt, K, Vector::Ones(n), 3);
    const std::vector<double> expected = chain_values(n, d);
    ASSERT_EQ(found.values.size(), 3);
    for (Index i = 0; i < 3; ++i) EXPECT_NEAR(found.values[i], expected[static_cast<std::size_t>(i)], tolerance);
    EXPECT_LE((found.vectors->transpose() * *found.vectors - Matrix::Identity(3, 3)).norm(), 1e-13);
    // Residuals of the vectors are the root of the values' errors.
    EXPECT_LE((chain(n, d) * *found.vectors - *found.vectors * found.values.asDiagonal()).norm(), 1e-4);
  }
}

TEST(NearNull, FindsTheNullVectorWithAShiftedFactorization) {
  // A chain that is held nowhere: its null vector is constant.
  constexpr Index n = 20;
  Matrix K = chain(n, 2.0);
  K(0, 0) = K(n - 1, n - 1) = 1.0;
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(test::lower_triangle(K + 1e-9 * Matrix::Identity(n, n))), FactorStatus::ok);
  const NearNull found = near_null(ldlt, test::lower_triangle(K), Vector::Ones(n), 1);
  EXPECT_NEAR(found.values[0], 0.0, 1e-14);
  EXPECT_NEAR(std::abs(found.vectors->col(0).sum()), std::sqrt(double(n)), 1e-12);
}

TEST(NearNull, WeightsMakeTheGeneralisedProblem) {
  constexpr Index n = 15;
  const Matrix K = chain(n, 0.35);
  const Vector weights = Vector::LinSpaced(n, 0.5, 2.0);
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(test::lower_triangle(K)), FactorStatus::ok);
  const NearNull found = near_null(ldlt, test::lower_triangle(K), weights, 2);
  Vector expected = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(K, Matrix(weights.asDiagonal())).eigenvalues();
  std::sort(expected.begin(), expected.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  for (Index i = 0; i < 2; ++i) EXPECT_NEAR(found.values[i], expected[i], tolerance);
  const Matrix product = found.vectors->transpose() * weights.asDiagonal() * *found.vectors;
  EXPECT_LE((product - Matrix::Identity(2, 2)).norm(), 1e-13);
}

TEST(NearNull, MultipliersOfWeightZeroLeaveTheSpaceThatTheyHold) {
  // The middle of a chain is held by a multiplier: two chains of half the length, each eigenvalue twice.
  constexpr Index n = 11, half = 5;
  Matrix A = Matrix::Zero(n + 1, n + 1);
  A.topLeftCorner(n, n) = chain(n, 2.0);
  A(n, half) = A(half, n) = -1.0;
  Vector weights = Vector::Ones(n + 1);
  weights[n] = 0.0;
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(test::lower_triangle(A), {.multipliers = 1}), FactorStatus::ok);
  const NearNull found = near_null(ldlt, test::lower_triangle(A), weights, 2);
  ASSERT_EQ(found.values.size(), 2);
  const double least = 2.0 - 2.0 * std::cos(pi / double(half + 1));
  EXPECT_NEAR(found.values[0], least, tolerance);
  EXPECT_NEAR(found.values[1], least, tolerance);
  EXPECT_NEAR(found.vectors->row(half).norm(), 0.0, 1e-9);
}

// One step each while d approaches the critical 2 cos(π/(n+1)): where singularity is near, so are the estimates.
TEST(NearNull, TheTrackerFollowsTheNearestPairsOfAChangingMatrix) {
  constexpr Index n = 30;
  const double critical = 2.0 * std::cos(pi / double(n + 1));
  NearNullTracker tracker;
  Ldlt ldlt;
  NearNull found;
  for (const double distance : {0.3, 0.1, 0.03, 0.01, 0.001, 1e-6}) {
    const double d = critical + distance;
    ASSERT_EQ(ldlt.factorize(test::lower_triangle(chain(n, d))), FactorStatus::ok);
    Matrix columns = tracker.right_hand_sides(Vector::Ones(n));
    ldlt.solve(columns);
    found = tracker.advance(Vector::Ones(n), columns);
    ASSERT_EQ(found.values.size(), 2);
    const std::vector<double> exact = chain_values(n, d);
    // A Rayleigh quotient of a definite matrix is no less than the least eigenvalue, but for the round-off of entries
    // of size d.
    EXPECT_GE(found.values[0], exact[0] * (1.0 - 1e-12) - std::numeric_limits<double>::epsilon() * d);
    EXPECT_LE(found.values[0], 2.0 * exact[0]);
  }
  EXPECT_NEAR(found.values[0], 1e-6, 1e-13);
}

// A start along the first mode and its like alone would never see the second of a symmetric chain.
TEST(NearNull, TheTrackerSeesAModeThatItsStartDoesNotHave) {
  constexpr Index n = 30;
  const double second = 2.0 * std::cos(2.0 * pi / double(n + 1));
  const Vector symmetric =
      Vector::LinSpaced(n, 1.0, double(n)).unaryExpr([](double k) { return std::sin(k * pi / double(n + 1)); });
  NearNullTracker tracker;
  tracker.start_from(Matrix(symmetric));
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(test::lower_triangle(chain(n, second + 1e-6))), FactorStatus::ok);
  Matrix columns = tracker.right_hand_sides(Vector::Ones(n));
  ldlt.solve(columns);
  EXPECT_NEAR(tracker.advance(Vector::Ones(n), columns).values[0], 1e-6, 1e-10);
}

TEST(NearNull, WithAsManyMultipliersAsUnknownsThereAreNoPairs) {
  Vector weights = Vector::Ones(2);
  weights[1] = 0.0;
  EXPECT_EQ(pair_count(weights), 0);
  NearNullTracker tracker;
  EXPECT_EQ(tracker.right_hand_sides(weights).cols(), 0);
  EXPECT_EQ(tracker.advance(weights, Matrix(2, 0)).values.size(), 0);
}

TEST(NearNull, ASmallMatrixHasNoMorePairsThanRows) {
  const SparseMatrix K = test::lower_triangle(Vector(Vector::LinSpaced(2, 3.0, 5.0)).asDiagonal());
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(K), FactorStatus::ok);
  const NearNull found = near_null(ldlt, K, Vector::Ones(2), 4);
  ASSERT_EQ(found.values.size(), 2);
  EXPECT_NEAR(found.values[0], 3.0, 1e-14);
  EXPECT_NEAR(found.values[1], 5.0, 1e-14);
}

}  // namespace arcwall::near_null_test
