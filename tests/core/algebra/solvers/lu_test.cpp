#include "core/algebra/solvers/lu.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/dense.hpp"

namespace arcwall::lu_test {

namespace {

SparseMatrix sparse(const Matrix& A) {
  SparseMatrix S = A.sparseView();
  S.makeCompressed();
  return S;
}

Matrix random_matrix(Index n, test::Numbers& numbers) {
  const Matrix A = numbers.matrix(n, n);
  return (A.array().abs() < 0.5).select(0.0, A);
}

// Elimination with pivoting: n ε κ with κ the condition number.
void expect_solves(const Lu& lu, const Matrix& A, test::Numbers& numbers) {
  const Matrix expected = numbers.matrix(A.rows(), 2);
  Matrix X = A * expected;
  lu.solve(X);
  const Vector values = Eigen::JacobiSVD<Matrix>(A).singularValues();
  const double condition = values.maxCoeff() / values.minCoeff();
  EXPECT_LE((X - expected).norm(),
            4.0 * double(A.rows()) * std::numeric_limits<double>::epsilon() * condition * expected.norm());
}

}  // namespace

TEST(Lu, SolvesUnsymmetricMatricesOfChangingPatternAndSize) {
  test::Numbers numbers(6);
  Lu lu;
  for (const Index n : {1, 8, 30, 8}) {
    SCOPED_TRACE(n);
    const Matrix A = n == 1 ? Matrix(Matrix::Constant(1, 1, -3.0)) : random_matrix(n, numbers);
    ASSERT_EQ(lu.factorize(sparse(A)), FactorStatus::ok);
    expect_solves(lu, A, numbers);
  }
}

TEST(Lu, TheSamePatternIsFactorizedAgainWithOtherValues) {
  test::Numbers numbers(7);
  Matrix A = random_matrix(15, numbers) + 3.0 * Matrix::Identity(15, 15);
  Lu lu;
  for (int round = 0; round < 3; ++round) {
    ASSERT_EQ(lu.factorize(sparse(A)), FactorStatus::ok);
    expect_solves(lu, A, numbers);
    A = (A + Matrix(numbers.vector(15).asDiagonal())).eval();
  }
}

TEST(Lu, PivotsWhereTheDiagonalIsZero) {
  const Matrix A = Matrix{{0.0, 2.0}, {1.0, 0.0}};
  Lu lu;
  ASSERT_EQ(lu.factorize(sparse(A)), FactorStatus::ok);
  Matrix X = Matrix{{2.0}, {3.0}};
  lu.solve(X);
  EXPECT_EQ(X, (Matrix{{3.0}, {1.0}}));
}

TEST(Lu, FindsSingularMatricesAndEntriesThatAreNotFinite) {
  Lu lu;
  EXPECT_EQ(lu.factorize(sparse(Matrix::Ones(3, 3))), FactorStatus::singular);
  Matrix bad = Matrix::Ones(3, 3);
  bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lu.factorize(sparse(bad)), FactorStatus::not_finite);
  bad(1, 2) = infinity;
  EXPECT_EQ(lu.factorize(sparse(bad)), FactorStatus::not_finite);
  EXPECT_EQ(lu.factorize(sparse(Matrix::Identity(3, 3))), FactorStatus::ok);
}

TEST(Lu, DoesNotShowTheSigns) {
  Lu lu;
  ASSERT_EQ(lu.factorize(sparse(Matrix::Identity(2, 2))), FactorStatus::ok);
  EXPECT_FALSE(lu.inertia().has_value());
}

}  // namespace arcwall::lu_test
