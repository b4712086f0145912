#include "core/algebra/singular_bordered_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "tests/support/dense.hpp"

namespace arcwall::singular_bordered_solver_test {

namespace {

constexpr Index n = 14;

// Eigenvalues of both signs, of which the first `zeros` vanish.
struct Singular {
  Matrix K;
  Matrix nulls;

  Singular(Index zeros, test::Numbers& numbers) {
    const Matrix Q = Eigen::HouseholderQR<Matrix>(numbers.matrix(n, n)).householderQ();
    Vector values(n);
    for (Index i = 0; i < n; ++i) values[i] = i < zeros ? 0.0 : double(i + 1) * (i % 2 == 0 ? 1.0 : -1.0);
    const Matrix A = Q * values.asDiagonal() * Q.transpose();
    K = 0.5 * (A + A.transpose());
    nulls = Q.leftCols(zeros);
  }
};

Linearization equations(const Matrix& K, const Vector& F_lambda) {
  Linearization now;
  now.F = Vector::Zero(K.rows());
  now.K = test::lower_triangle(K);
  now.F_lambda = F_lambda;
  return now;
}

// Against LU with complete pivoting of the dense whole.
void expect_solution(const Linearization& now, const Row& border, SingularBorderedSolver& solver,
                     test::Numbers& numbers) {
  const Index size = now.K.cols(), m = now.B.cols(), last = size + m;
  Matrix whole = Matrix::Zero(last + 1, last + 1);
  whole.topLeftCorner(size, size) = test::full(now.K);
  if (m > 0) {
    whole.block(0, size, size, m) = now.B;
    whole.block(size, 0, m, last) = now.C;
  }
  whole.col(last).head(last) = now.F_lambda;
  whole.row(last).head(last) = border.dx.transpose();
  whole(last, last) = border.dlambda;
  Vector right(last + 1);
  right << numbers.vector(last), 0.7;
  const Vector expected = Eigen::FullPivLU<Matrix>(whole).solve(right);
  const auto solution = solver.solve(right.head(last), right[last]);
  ASSERT_TRUE(solution);
  EXPECT_LE((solution->dx - expected.head(last)).norm(), 1e-9 * expected.norm());
  EXPECT_NEAR(solution->dlambda, expected[last], 1e-9 * expected.norm());
}

}  // namespace

TEST(SingularBorderedSolver, SolvesWhereKIsSingular) {
  test::Numbers numbers(61);
  for (int round = 0; round < 20; ++round) {
    const Singular at(1, numbers);
    Linearization now = equations(at.K, at.nulls.col(0) + 0.3 * numbers.vector(n));
    const Row border{.dx = at.nulls.col(0) + 0.3 * numbers.vector(n), .dlambda = 0.2};
    SingularBorderedSolver solver;
    solver.factorize(now, border, 0, at.nulls.col(0));
    expect_solution(now, border, solver, numbers);
  }
}

// Points of contact that slide stand last in x, and J is not symmetric.
TEST(SingularBorderedSolver, SolvesWhereKIsSingularInsideABorder) {
  test::Numbers numbers(64);
  for (const Index m : {1, 2, 4})
    for (int round = 0; round < 10; ++round) {
      SCOPED_TRACE(m);
      const Singular at(1, numbers);
      Linearization now = equations(at.K, numbers.vector(n + m));
      now.F = Vector::Zero(n + m);
      now.B = numbers.matrix(n, m);
      now.C = numbers.matrix(m, n + m);
      now.C.rightCols(m) += 3.0 * Matrix::Identity(m, m);
      const Row border{.dx = numbers.vector(n + m), .dlambda = 0.2};
      SingularBorderedSolver solver;
      solver.factorize(now, border, 0, at.nulls.col(0));
      expect_solution(now, border, solver, numbers);
    }
}

// The spring is put where it stiffens nothing.
TEST(SingularBorderedSolver, SolvesAlsoWhereTheSoftDirectionIsMistaken) {
  test::Numbers numbers(62);
  Matrix K = Matrix::Zero(n, n);
  K.topLeftCorner(n - 1, n - 1) = 2.0 * Matrix::Identity(n - 1, n - 1);
  K(0, 1) = K(1, 0) = 0.5;
  Linearization now = equations(K, Vector::Unit(n, n - 1) + numbers.vector(n));
  const Row border{.dx = Vector::Unit(n, n - 1) + 0.1 * numbers.vector(n), .dlambda = 0.2};
  SingularBorderedSolver solver;
  solver.factorize(now, border, 0, Vector::Unit(n, 0));
  expect_solution(now, border, solver, numbers);
}

TEST(SingularBorderedSolver, SolvesSaddlePoints) {
  test::Numbers numbers(63);
  constexpr Index m = 2;
  const Singular at(1, numbers);
  Matrix K = Matrix::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = at.K;
  K.bottomLeftCorner(m, n) = numbers.matrix(m, n);
  K.bottomLeftCorner(m, n) -= K.bottomLeftCorner(m, n) * at.nulls * at.nulls.transpose();  // still singular
  K.topRightCorner(n, m) = K.bottomLeftCorner(m, n).transpose();
  Vector soft = Vector::Zero(n + m);
  soft.head(n) = at.nulls.col(0);
  Linearization now = equations(K, soft + 0.3 * numbers.vector(n + m));
  const Row border{.dx = soft + 0.3 * numbers.vector(n + m), .dlambda = 0.2};
  SingularBorderedSolver solver;
  solver.factorize(now, border, m, soft);
  expect_solution(now, border, solver, numbers);
}

TEST(SingularBorderedSolver, SaysWhereOneBorderIsNotEnough) {
  test::Numbers numbers(64);
  const Singular at(2, numbers);
  Linearization now = equations(at.K, numbers.vector(n));
  const Row border{.dx = numbers.vector(n), .dlambda = 0.2};
  SingularBorderedSolver solver;
  solver.factorize(now, border, 0, at.nulls.col(0));
  const Vector f = numbers.vector(n);
  const auto solution = solver.solve(f, 0.7);
  // What round-off lets pass is no small solution.
  EXPECT_GT(solution ? solution->dx.norm() : infinity, 1e9 * f.norm());
}

}  // namespace arcwall::singular_bordered_solver_test
