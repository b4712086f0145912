#include "core/algebra/solvers/modified_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/algebra/ldlt.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::modified_cholesky_test {

namespace {

using test::lower_triangle;
using test::Numbers;

// Five-point differences on side × side points held around: eigenvalues 4 − 2 cos(iπ/(side+1)) − 2 cos(jπ/(side+1)),
// i, j = 1 … side. Less `shift` on the diagonal.
SparseMatrix grid(Index side, double shift) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column) {
      const Index here = row * side + column;
      entries.emplace_back(here, here, 4.0 - shift);
      if (column + 1 < side) entries.emplace_back(here + 1, here, -1.0);
      if (row + 1 < side) entries.emplace_back(here + side, here, -1.0);
    }
  SparseMatrix A(side * side, side * side);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

Vector grid_eigenvalues(Index side) {
  Vector values(side * side);
  const double angle = pi / double(side + 1);
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j)
      values[i * side + j] = 4.0 - 2.0 * std::cos(double(i + 1) * angle) - 2.0 * std::cos(double(j + 1) * angle);
  std::sort(values.begin(), values.end());
  return values;
}

// Between the eigenvalues, so that `negative` are below zero.
double shift_for(Index negative, const Vector& values) {
  Index next = negative;
  while (values[next] - values[next - 1] < 1e-3 * values[next]) ++next;  // pairs are equal
  return 0.5 * (values[next - 1] + values[next]);
}

Index below(const Vector& values, double shift) { return (values.array() < shift).count(); }

void expect_solves(const SymmetricFactors& factors, const SparseMatrix& A, double condition, Numbers& numbers) {
  for (const Index columns : {1, 2, 5}) {
    const Matrix expected = numbers.matrix(A.cols(), columns);
    Matrix X = A.selfadjointView<Eigen::Lower>() * expected;
    factors.solve(X);
    EXPECT_LE((X - expected).norm(), 1e-14 * condition * expected.norm());
  }
}

}  // namespace

TEST(ModifiedCholesky, CountsAndSolvesWithNegativeEigenvalues) {
  Numbers numbers(31);
  const Vector values = grid_eigenvalues(20);
  for (const Index negative : {0, 1, 2, 5}) {
    SCOPED_TRACE(negative);
    const double shift = negative == 0 ? 0.0 : shift_for(negative, values);
    const SparseMatrix A = grid(20, shift);
    const auto factors = any_modified_cholesky(A);
    ASSERT_EQ(factors->factorize(A, {}), FactorStatus::ok);
    EXPECT_EQ(factors->pivots().signs.negative, below(values, shift));
    EXPECT_EQ(factors->pivots().signs.positive, A.cols() - below(values, shift));
    const double nearest = (values.array() - shift).abs().minCoeff();
    expect_solves(*factors, A, 8.0 * values[399] / nearest, numbers);
    // |v|ᵀ |L| |D| |L|ᵀ |v| is at least |vᵀ A v|.
    const Vector v = numbers.vector(A.cols());
    EXPECT_GE(factors->weighted(v), std::abs(v.dot(A.selfadjointView<Eigen::Lower>() * v)) * (1.0 - 1e-12));
  }
}

TEST(ModifiedCholesky, ServesWithASoftVectorThatIsExpected) {
  Numbers numbers(32);
  const Vector values = grid_eigenvalues(20);
  const double shift = shift_for(1, values);
  const SparseMatrix A = grid(20, shift);
  Matrix softest(400, 1);
  for (Index i = 0; i < 400; ++i)
    softest(i, 0) = std::sin(pi * double(i / 20 + 1) / 21.0) * std::sin(pi * double(i % 20 + 1) / 21.0);
  const auto factors = any_modified_cholesky(A);
  factors->expect_near_null(softest);
  ASSERT_EQ(factors->factorize(A, {}), FactorStatus::ok);
  EXPECT_EQ(factors->pivots().signs.negative, 1);
  expect_solves(*factors, A, 8.0 * values[399] / (values.array() - shift).abs().minCoeff(), numbers);
}

// Springs that were needed once do not change what follows once vectors are told again.
TEST(ModifiedCholesky, ResultsDoNotDependOnWhatWasFactorizedBefore) {
  Numbers numbers(33);
  const Vector values = grid_eigenvalues(20);
  const SparseMatrix harder = grid(20, shift_for(5, values)), A = grid(20, shift_for(2, values));
  const Matrix right = numbers.matrix(400, 2), soft = numbers.matrix(400, 1);
  const auto fresh = any_modified_cholesky(A), used = any_modified_cholesky(A);
  used->expect_near_null(numbers.matrix(400, 2));
  ASSERT_EQ(used->factorize(harder, {}), FactorStatus::ok);
  Matrix one = right, other = right;
  for (const auto& [factors, X] : {std::pair(fresh.get(), &one), std::pair(used.get(), &other)}) {
    factors->expect_near_null(soft);
    ASSERT_EQ(factors->factorize(A, {}), FactorStatus::ok);
    factors->solve(*X);
  }
  EXPECT_EQ(one, other);
}

TEST(ModifiedCholesky, SeesExactlySingularMatrices) {
  const Matrix block{{1.0, 1.0}, {1.0, 1.0}};
  Matrix A = Matrix::Zero(6, 6);
  for (Index i = 0; i < 6; i += 2) A.block(i, i, 2, 2) = block;
  const SparseMatrix singular = lower_triangle(A);
  EXPECT_EQ(any_modified_cholesky(singular)->factorize(singular, {}), FactorStatus::singular);
  const SparseMatrix nothing = grid(20, 4.0);
  EXPECT_EQ(any_modified_cholesky(nothing)->factorize(nothing, {}), FactorStatus::singular)
      << "no diagonal tells how stiff a spring should be";
}

// Many negative eigenvalues are left to the simplicial LDLᵀ, and few unknowns or a tree as well.
TEST(ModifiedCholesky, IsChosenForLargeGridsAndReplacedWhereItRefuses) {
  Numbers numbers(34);
  constexpr Index side = 120;
  const Vector values = grid_eigenvalues(side);
  EXPECT_EQ(modified_cholesky(grid(60, 0.0)), nullptr);
  EXPECT_NE(modified_cholesky(grid(side, 0.0)), nullptr);
  Ldlt ldlt;
  for (const Index negative : {4, 8, 60, 1}) {
    SCOPED_TRACE(negative);
    const double shift = shift_for(negative, values);
    const SparseMatrix A = grid(side, shift);
    ldlt.expect_near_null(Matrix());
    ASSERT_EQ(ldlt.factorize(A), FactorStatus::ok);
    EXPECT_EQ(ldlt.inertia()->negative, below(values, shift));
    const Matrix expected = numbers.matrix(A.cols(), 2);
    Matrix X = A.selfadjointView<Eigen::Lower>() * expected;
    ldlt.solve(X);
    EXPECT_LE((X - expected).norm(), 1e-8 * expected.norm());
  }
}

}  // namespace arcwall::modified_cholesky_test
