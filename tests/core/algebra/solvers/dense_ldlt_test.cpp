#include "core/algebra/solvers/dense_ldlt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/support/dense.hpp"

namespace arcwall::dense_ldlt_test {

using test::Numbers;

// Signs by the eigenvalues that Eigen finds.
TEST(DenseLdlt, SolvesAndCountsIndefiniteMatrices) {
  Numbers numbers(41);
  for (const Index n : {1, 2, 3, 10, 150}) {
    SCOPED_TRACE(n);
    const Matrix half = numbers.matrix(n, n), A = half + half.transpose(), X = numbers.matrix(n, 3);
    const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues();
    DenseLdlt ldlt;
    ASSERT_TRUE(ldlt.factorize(A.triangularView<Eigen::Lower>()));
    const Index negative = (eigenvalues.array() < 0.0).count();
    EXPECT_EQ(ldlt.pivots().signs.negative, negative);
    EXPECT_EQ(ldlt.pivots().signs.positive, n - negative);
    Matrix solution = A * X;
    ldlt.solve(solution);
    const double condition = eigenvalues.cwiseAbs().maxCoeff() / eigenvalues.cwiseAbs().minCoeff();
    EXPECT_LE((solution - X).norm(), 1e-14 * condition * X.norm());
  }
}

// Neither has a pivot on its diagonal.
TEST(DenseLdlt, TakesTwoRowsWhereNoneIsAPivot) {
  const Matrix A{{0.0, 2.0}, {2.0, 0.0}};
  DenseLdlt ldlt;
  ASSERT_TRUE(ldlt.factorize(A));
  EXPECT_EQ(ldlt.pivots().signs.negative, 1);
  EXPECT_EQ(ldlt.pivots().signs.positive, 1);
  EXPECT_DOUBLE_EQ(ldlt.pivots().least, 2.0);
  EXPECT_DOUBLE_EQ(ldlt.pivots().greatest, 2.0);
}

TEST(DenseLdlt, RefusesSingularMatricesAndWhatIsNoNumber) {
  DenseLdlt ldlt;
  EXPECT_FALSE(ldlt.factorize(Matrix::Zero(3, 3)));
  EXPECT_FALSE(ldlt.factorize(Matrix::Ones(2, 2)));
  EXPECT_FALSE(ldlt.factorize(Matrix::Constant(2, 2, std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace arcwall::dense_ldlt_test
