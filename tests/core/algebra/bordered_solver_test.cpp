#include "core/algebra/bordered_solver.hpp"

#include <gtest/gtest.h>

#include "tests/support/dense.hpp"

namespace arcwall::bordered_solver_test {

namespace {

Linearization equations(const Matrix& K, const Vector& F, const Vector& F_lambda) {
  Linearization now;
  now.F = F;
  now.K = test::lower_triangle(K);
  now.F_lambda = F_lambda;
  return now;
}

// Symmetric of size n with eigenvalues 1 … n of alternating sign, but the first as given.
Matrix with_first_eigenvalue(double first, Index n, Vector& null, test::Numbers& numbers) {
  const Matrix Q = Eigen::HouseholderQR<Matrix>(numbers.matrix(n, n)).householderQ();
  Vector values(n);
  for (Index i = 0; i < n; ++i) values[i] = double(i + 1) * (i % 2 == 0 ? 1.0 : -1.0);
  values[0] = first;
  null = Q.col(0);
  const Matrix A = Q * values.asDiagonal() * Q.transpose();
  return 0.5 * (A + A.transpose());
}

// Errors stay at a few hundred ε for any first eigenvalue when the bordered matrix is well conditioned; 1e-9 is what
// the solver itself promises (a residual of 1e-10) times its condition number, about 10.
constexpr double tolerance = 1e-9;

void expect_line(const Linearization& now, const EquilibriumLine& line) {
  const Matrix K = test::full(now.K);
  const double along = line.tangent().dx.norm() + std::abs(line.tangent().dlambda);
  EXPECT_GT(along, 0.0);
  EXPECT_LE((K * line.tangent().dx + now.F_lambda * line.tangent().dlambda).norm(), tolerance * along);
  EXPECT_LE((K * line.particular().dx + now.F_lambda * line.particular().dlambda + now.F).norm(),
            tolerance * (now.F.norm() + line.particular().dx.norm()));
}

}  // namespace

TEST(BorderedSolver, SolvesWhetherKIsRegularNearlySingularOrSingular) {
  test::Numbers numbers(8);
  constexpr Index n = 12;
  for (const double first : {1.0, -1e-3, 1e-8, -1e-12, 1e-15, 0.0}) {
    SCOPED_TRACE(first);
    Vector null;
    const Matrix K = with_first_eigenvalue(first, n, null, numbers);
    // A border that makes the whole regular: both have a component along the near-null vector.
    const Vector F_lambda = null + 0.3 * numbers.vector(n);
    const Row border{.dx = null + 0.3 * numbers.vector(n), .dlambda = 0.2};
    Linearization now = equations(K, numbers.vector(n), F_lambda);
    BorderedSolver solver;
    ASSERT_NE(solver.factorize(now, 0), FactorStatus::not_finite);

    EquilibriumLine line;
    ASSERT_TRUE(solver.line(border, Vector::Ones(n), line));
    expect_line(now, line);

    const Vector f = numbers.vector(n);
    const auto solution = solver.solve(border, f, 0.7);
    ASSERT_TRUE(solution.has_value());
    Matrix whole(n + 1, n + 1);
    whole << K, F_lambda, border.dx.transpose(), border.dlambda;
    Vector right(n + 1);
    right << f, 0.7;
    const Vector expected = Eigen::FullPivLU<Matrix>(whole).solve(right);
    EXPECT_LE((solution->dx - expected.head(n)).norm(), tolerance * expected.norm());
    EXPECT_NEAR(solution->dlambda, expected[n], tolerance * expected.norm());
  }
}

TEST(BorderedSolver, AnExactlySingularKStillHasALine) {
  // K = diag(1, 0), F_λ = (0, 1): a limit point with tangent (0, 1, 0).
  const Matrix K = Vector(Vector::Unit(2, 0)).asDiagonal();
  Linearization now = equations(K, Vector::Ones(2), Vector::Unit(2, 1));
  BorderedSolver solver;
  EXPECT_EQ(solver.factorize(now, 0), FactorStatus::singular);
  EXPECT_FALSE(solver.inner_is_regular());
  EXPECT_FALSE(solver.inner().inertia().has_value());
  EquilibriumLine line;
  ASSERT_TRUE(solver.line({.dx = Vector::Unit(2, 1), .dlambda = 0.0}, Vector::Ones(2), line));
  EXPECT_NEAR(line.tangent().dlambda, 0.0, 1e-15);
  EXPECT_NEAR(line.tangent().dx[0], 0.0, 1e-15);
  EXPECT_NEAR(std::abs(line.tangent().dx[1]), 1.0, 1e-15);
  expect_line(now, line);
}

TEST(BorderedSolver, SaysWhereTheBorderedMatrixIsSingularToo) {
  // F_λ lies in the range of K: a branch point, which no border closes with one column.
  const Matrix K = Vector(Vector::Unit(2, 0)).asDiagonal();
  Linearization now = equations(K, Vector::Ones(2), Vector::Unit(2, 0));
  BorderedSolver solver;
  EXPECT_EQ(solver.factorize(now, 0), FactorStatus::singular);
  const Row border{.dx = Vector::Zero(2), .dlambda = 1.0};
  EquilibriumLine line;
  EXPECT_FALSE(solver.line(border, Vector::Ones(2), line));
  EXPECT_FALSE(solver.solve(border, Vector::Ones(2), 1.0).has_value());
}

TEST(BorderedSolver, WorksOnSaddlePoints) {
  test::Numbers numbers(9);
  constexpr Index n = 8, m = 2;
  Matrix K = Matrix::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = 2.0 * Matrix::Identity(n, n);
  K.bottomLeftCorner(m, n) = numbers.matrix(m, n);
  K.topRightCorner(n, m) = K.bottomLeftCorner(m, n).transpose();
  Vector F_lambda = Vector::Zero(n + m);
  F_lambda.head(n) = numbers.vector(n);
  Linearization now = equations(K, numbers.vector(n + m), F_lambda);
  BorderedSolver solver;
  ASSERT_EQ(solver.factorize(now, m), FactorStatus::ok);
  ASSERT_TRUE(solver.inner().inertia().has_value());
  EXPECT_EQ(solver.inner().inertia()->negative, m);
  EquilibriumLine line;
  ASSERT_TRUE(solver.line({.dx = Vector::Zero(n + m), .dlambda = 1.0}, Vector::Ones(n + m), line));
  expect_line(now, line);
  Matrix X = numbers.matrix(n + m, 2);
  const Matrix right = X;
  solver.inner().solve(X);
  EXPECT_LE((K * X - right).norm(), 1e-13 * right.norm() * K.norm());
}

TEST(BorderedSolver, FindsEntriesThatAreNotFinite) {
  Matrix K = Matrix::Identity(2, 2);
  K(1, 0) = infinity;
  Linearization now = equations(K, Vector::Ones(2), Vector::Ones(2));
  BorderedSolver solver;
  EXPECT_EQ(solver.factorize(now, 0), FactorStatus::not_finite);
}

}  // namespace arcwall::bordered_solver_test
