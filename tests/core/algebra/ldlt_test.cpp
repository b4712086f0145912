#include "core/algebra/ldlt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/algebra/block_tridiagonal/blocks.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::ldlt_test {

namespace {

using test::full;
using test::lower_triangle;
using test::Numbers;

// Symmetric, a third of the entries not zero, eigenvalues of both signs.
Matrix indefinite(Index n, Numbers& numbers) {
  Matrix A = numbers.matrix(n, n);
  A = (A.array().abs() < 2.0 / 3.0).select(0.0, A).eval();
  const Matrix symmetric = A + A.transpose();
  return symmetric + Matrix(numbers.vector(n).asDiagonal());
}

// [K −Gᵀ; −G 0] with K = B Bᵀ/n + 1, made indefinite where `shift` is above 1.
Matrix saddle_point(Index n, Index m, double shift, Numbers& numbers) {
  const Matrix B = numbers.matrix(n, n), G = numbers.matrix(m, n);
  Matrix A = Matrix::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = B * B.transpose() / double(n) + (1.0 - shift) * Matrix::Identity(n, n);
  A.bottomLeftCorner(m, n) = -G;
  A.topRightCorner(n, m) = -G.transpose();
  return A;
}

void expect_inertia(const Ldlt& ldlt, const Matrix& A) {
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
  ASSERT_TRUE(ldlt.inertia().has_value());
  EXPECT_EQ(ldlt.inertia()->negative, (values.array() < 0.0).count());
  EXPECT_EQ(ldlt.inertia()->positive, (values.array() > 0.0).count());
}

// Without pivoting the error is that of a stable elimination times the growth of the entries, at most the reciprocal of
// the pivot ratio.
void expect_solves(const Ldlt& ldlt, const Matrix& A, Numbers& numbers) {
  const Matrix expected = numbers.matrix(A.rows(), 3);
  Matrix X = A * expected;
  ldlt.solve(X);
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
  const double condition = values.maxCoeff() / values.minCoeff();
  const double n = double(A.rows()), epsilon = std::numeric_limits<double>::epsilon();
  EXPECT_LE((X - expected).norm(), n * epsilon * condition / ldlt.pivot_ratio() * expected.norm());
  EXPECT_LE((X - expected).norm(), 1e-6 * expected.norm());  // and the estimate above says something
}

}  // namespace

TEST(Ldlt, InertiaAndSolutionOfIndefiniteMatricesAreThoseOfTheDenseOnes) {
  Numbers numbers(2);
  for (const Index n : {1, 2, 5, 17, 40}) {
    SCOPED_TRACE(n);
    const Matrix A = indefinite(n, numbers);
    Ldlt ldlt;
    ASSERT_EQ(ldlt.factorize(lower_triangle(A)), FactorStatus::ok);
    expect_inertia(ldlt, A);
    expect_solves(ldlt, A, numbers);
  }
}

TEST(Ldlt, SaddlePointsHaveOneNegativePivotAMultiplierMore) {
  Numbers numbers(3);
  for (const double shift : {0.0, 1.2})
    for (const Index m : {1, 3, 8}) {
      SCOPED_TRACE(m);
      const Matrix A = saddle_point(20, m, shift, numbers);
      Ldlt ldlt;
      ASSERT_EQ(ldlt.factorize(lower_triangle(A), {.multipliers = m}), FactorStatus::ok);
      expect_inertia(ldlt, A);
      expect_solves(ldlt, A, numbers);
      if (shift == 0.0) {
        EXPECT_EQ(ldlt.inertia()->negative, m);
      }
    }
}

TEST(Ldlt, AMultiplierThatHoldsOneUnknownNeedsNoPivoting) {
  // [k −1; −1 0]: whatever k, one eigenvalue of each sign.
  for (const double k : {1.0, 1e-30, -1.0}) {
    const Matrix A = Matrix{{k, -1.0}, {-1.0, 0.0}};
    Ldlt ldlt;
    ASSERT_EQ(ldlt.factorize(lower_triangle(A), {.multipliers = 1}), FactorStatus::ok);
    EXPECT_EQ(ldlt.inertia()->negative, 1);
    EXPECT_EQ(ldlt.inertia()->positive, 1);
  }
}

TEST(Ldlt, TheSamePatternIsFactorizedAgainWithOtherValues) {
  Numbers numbers(4);
  Matrix A = indefinite(25, numbers);
  Ldlt ldlt;
  for (int round = 0; round < 4; ++round) {
    ASSERT_EQ(ldlt.factorize(lower_triangle(A)), FactorStatus::ok);
    expect_inertia(ldlt, A);
    expect_solves(ldlt, A, numbers);
    A.diagonal() = numbers.vector(25);
  }
}

TEST(Ldlt, FollowsChangesOfPatternSizeAndMultipliers) {
  Numbers numbers(5);
  Ldlt ldlt;
  for (const Index m : {0, 2, 5, 0}) {
    for (const Index n : {10, 12, 10}) {
      const Matrix A = m > 0 ? saddle_point(n, m, 0.0, numbers) : indefinite(n, numbers);
      ASSERT_EQ(ldlt.factorize(lower_triangle(A), {.multipliers = m}), FactorStatus::ok);
      expect_inertia(ldlt, A);
      expect_solves(ldlt, A, numbers);
    }
  }
}

TEST(Ldlt, FindsEntriesThatAreNotFinite) {
  Matrix A = Matrix::Identity(4, 4);
  Ldlt ldlt;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity}) {
    A(2, 1) = bad;
    EXPECT_EQ(ldlt.factorize(lower_triangle(A, -1.0)), FactorStatus::not_finite);
    EXPECT_FALSE(ldlt.inertia().has_value());
  }
  EXPECT_EQ(ldlt.factorize(lower_triangle(Matrix::Identity(4, 4))), FactorStatus::ok);
}

TEST(Ldlt, FindsAZeroPivot) {
  const Matrix rank_one = Matrix::Ones(3, 3);
  Matrix empty_row = Matrix::Identity(3, 3);
  empty_row(1, 1) = 0.0;
  for (const Matrix& A : {rank_one, empty_row, Matrix(Matrix::Zero(1, 1))}) {
    Ldlt ldlt;
    EXPECT_EQ(ldlt.factorize(lower_triangle(A)), FactorStatus::singular);
    EXPECT_FALSE(ldlt.inertia().has_value());
    EXPECT_EQ(ldlt.pivot_ratio(), 0.0);
  }
}

TEST(Ldlt, AMultiplierThatTouchesNothingIsSingular) {
  Matrix A = Matrix::Identity(4, 4);
  A(3, 3) = 0.0;
  Ldlt ldlt;
  EXPECT_EQ(ldlt.factorize(lower_triangle(A), {.multipliers = 1}), FactorStatus::singular);
}

TEST(Ldlt, RecoversAfterASingularMatrix) {
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(lower_triangle(Matrix::Ones(3, 3))), FactorStatus::singular);
  const Matrix A = Matrix::Ones(3, 3) + 2.0 * Matrix::Identity(3, 3);
  ASSERT_EQ(ldlt.factorize(lower_triangle(A)), FactorStatus::ok);
  expect_inertia(ldlt, A);
}

TEST(Ldlt, PivotRatioOfADiagonalMatrixIsLeastOverGreatest) {
  Ldlt ldlt;
  EXPECT_EQ(ldlt.pivot_ratio(), 0.0);
  const Matrix A = Vector(Vector::LinSpaced(4, -1.0, -4.0)).asDiagonal();
  ASSERT_EQ(ldlt.factorize(lower_triangle(A)), FactorStatus::ok);
  EXPECT_DOUBLE_EQ(ldlt.pivot_ratio(), 0.25);
}

// L D Lᵀ is K to within the bound: seen as what K x differs by after solving with the factors, x = vector v.
TEST(Ldlt, RoundoffGrowsWithTheFactors) {
  // [δ 1; 1 0] = L D Lᵀ with L = [1 0; 1/δ 1], D = (δ, −1/δ): |L| |D| |L|ᵀ = [δ 1; 1 2/δ].
  const double delta = std::ldexp(1.0, -20), epsilon = std::numeric_limits<double>::epsilon();
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(lower_triangle(Matrix{{delta, 1.0}, {1.0, 0.0}}, -1.0)), FactorStatus::ok);
  const double with_first = ldlt.roundoff(Vector{{1.0, 0.0}}), with_second = ldlt.roundoff(Vector{{0.0, 1.0}});
  EXPECT_DOUBLE_EQ(with_first + with_second, epsilon * (delta + 2.0 / delta));
  EXPECT_DOUBLE_EQ(std::min(with_first, with_second), epsilon * delta);
  EXPECT_DOUBLE_EQ(ldlt.roundoff(Vector{{1.0, -1.0}}), epsilon * (delta + 2.0 + 2.0 / delta));
}

TEST(Ldlt, CanBeMoved) {
  const Matrix A = 2.0 * Matrix::Identity(3, 3);
  Ldlt first;
  ASSERT_EQ(first.factorize(lower_triangle(A)), FactorStatus::ok);
  const Ldlt second = std::move(first);
  Matrix X = Matrix::Ones(3, 1);
  second.solve(X);
  EXPECT_EQ(X, Matrix::Constant(3, 1, 0.5));
}

// A chain of nodes with three unknowns each: a force that is an unknown is all that couples the third and the fourth,
// and moves none of the fifth. Two multipliers more hold something of the fourth.
TEST(Ldlt, AForceBetweenBlocksIsEliminatedWithOneOfThem) {
  Numbers numbers(5);
  constexpr Index nodes = 7, n = 3 * nodes, all = n + 3;
  Matrix A = Matrix::Zero(all, all);
  for (Index node = 0; node + 1 < nodes; ++node) {
    const Matrix B = numbers.matrix(6, 6), K = B * B.transpose() + Matrix::Identity(6, 6);
    if (node != 2) A.block(3 * node, 3 * node, 6, 6) += K;
  }
  A.block(9, 6, 3, 3).setConstant(1e-300);
  A.block(n, 6, 1, 6) = numbers.matrix(1, 6);
  A.block(n, 12, 1, 3).setConstant(1e-300);
  A.block(n + 1, 9, 2, 3) = numbers.matrix(2, 3);
  const Matrix symmetric = A.triangularView<Eigen::Lower>().toDenseMatrix() +
                           A.triangularView<Eigen::StrictlyLower>().toDenseMatrix().transpose();
  SparseMatrix lower = lower_triangle(symmetric, 1e-307);
  for (Index i = 0; i < all; ++i) lower.coeffRef(i, i) += 0.0;
  lower.makeCompressed();
  auto blocks = find_blocks(lower, 3, 6);
  ASSERT_TRUE(blocks);
  EXPECT_EQ(take_in_couplings(lower, 3, *blocks), Index{1});
  for (const std::vector<Index>& block : *blocks) {
    const bool is_of_fourth = std::find(block.begin(), block.end(), Index{9}) != block.end();
    EXPECT_EQ(block.size(), is_of_fourth ? 4U : 3U);
    EXPECT_EQ(block.back() == n, is_of_fourth);
  }
  Ldlt ldlt;
  ASSERT_EQ(ldlt.factorize(lower, {.multipliers = 3}), FactorStatus::ok);
  expect_inertia(ldlt, symmetric);
  expect_solves(ldlt, symmetric, numbers);
}

}  // namespace arcwall::ldlt_test
