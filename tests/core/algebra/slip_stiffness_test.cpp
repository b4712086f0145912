#include "core/algebra/slip_stiffness.hpp"

#include <gtest/gtest.h>

namespace arcwall::slip_stiffness_test {

namespace {

Matrix matrix(double a, double b, double c, double d) {
  Matrix D(2, 2);
  D << a, b, c, d;
  return D;
}

}  // namespace

TEST(SlipStiffness, CountsNegativeRealEigenvalues) {
  EXPECT_EQ(negative_real_eigenvalues(Matrix::Constant(1, 1, -2.0)), 1);
  EXPECT_EQ(negative_real_eigenvalues(matrix(1.0, 0.0, 0.0, 2.0)), 0);
  EXPECT_EQ(negative_real_eigenvalues(matrix(1.0, 2.0, 2.0, 1.0)), 1);     // 3, −1
  EXPECT_EQ(negative_real_eigenvalues(matrix(-1.0, 2.0, -2.0, -1.0)), 0);  // −1 ± 2i
}

// (1, 1) is an eigenvector of the first of value −1, of the second (1, −1), which no slip can follow.
TEST(SlipStiffness, TellsSlipsThatStartByThemselves) {
  EXPECT_EQ(slip_stability(matrix(1.0, 0.5, 0.5, 1.0)), SlipStability::stable);
  EXPECT_EQ(slip_stability(matrix(1.0, -2.0, -2.0, 1.0)), SlipStability::unstable);
  EXPECT_EQ(slip_stability(matrix(1.0, 2.0, 2.0, 1.0)), SlipStability::undecided);
  EXPECT_EQ(slip_stability(matrix(-1.0, 0.0, 0.0, 1.0)), SlipStability::unstable);
  EXPECT_EQ(slip_stability(matrix(-1.0, 0.0, -1.0, 1.0)), SlipStability::unstable);  // (2, 1): both start
}

}  // namespace arcwall::slip_stiffness_test
