#include "core/algebra/test_function.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/algebra/ldlt.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test_function_test {

namespace {

using test::lower_triangle;
using test::Numbers;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Index between(Index least, Index greatest, Numbers& numbers) {
  return least + static_cast<Index>(0.5 * (numbers() + 1.0) * double(greatest - least + 1));
}

Matrix orthogonal(Index n, Numbers& numbers) {
  return Eigen::HouseholderQR<Matrix>(numbers.matrix(n, n)).householderQ() * Matrix::Identity(n, n);
}

Matrix symmetric(const Matrix& A) { return 0.5 * (A + A.transpose()); }

// One to three values within 10⁻¹⁶ … 1 of zero, the others of order 1 and either sign.
Vector spectrum(Index n, Numbers& numbers) {
  Vector values = numbers.vector(n);
  for (double& value : values) value = std::copysign(0.01 + std::abs(value), value);
  for (Index i = 0; i < std::min(n, between(1, 3, numbers)); ++i)
    values[i] = std::copysign(std::pow(10.0, -8.0 * (numbers() + 1.0)), numbers());
  return values;
}

struct Case {
  Matrix A;
  Vector weights;
  Index multipliers;
};

Case symmetric_case(Index n, Numbers& numbers) {
  const Matrix Q = orthogonal(n, numbers);
  return {.A = symmetric(Q * spectrum(n, numbers).asDiagonal() * Q.transpose()),
          .weights = Vector::Ones(n),
          .multipliers = 0};
}

// [K −Gᵀ; −G 0] with the spectrum of K chosen on the null space Z of G, and anything beside it.
Case saddle_point_case(Index n, Index m, Numbers& numbers) {
  const Matrix G = numbers.matrix(m, n);
  const Matrix basis = Eigen::HouseholderQR<Matrix>(G.transpose()).householderQ();
  Matrix inner = numbers.matrix(n, n);
  const Matrix Q = orthogonal(n - m, numbers);
  inner.bottomRightCorner(n - m, n - m) = Q * spectrum(n - m, numbers).asDiagonal() * Q.transpose();
  inner.topRightCorner(m, n - m) = inner.bottomLeftCorner(n - m, m).transpose();
  Matrix A = Matrix::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = symmetric(basis * symmetric(inner) * basis.transpose());
  A.bottomLeftCorner(m, n) = -G;
  A.topRightCorner(n, m) = -G.transpose();
  Vector weights = Vector::Zero(n + m);
  weights.head(n).setOnes();
  return {.A = A, .weights = weights, .multipliers = m};
}

Case random_case(int which, Numbers& numbers) {
  if (which % 2 == 0) return symmetric_case(between(2, 30, numbers), numbers);
  const Index n = between(2, 24, numbers);
  return saddle_point_case(n, between(1, std::min<Index>(6, n - 1), numbers), numbers);
}

// By the pivots where they tell, else by Ψ, as it is done along a path.
std::optional<SignCount> counted(const Case& one, bool& by_pivots) {
  const SparseMatrix K = lower_triangle(one.A);
  Ldlt ldlt;
  by_pivots = false;
  if (ldlt.factorize(K, {.multipliers = one.multipliers}) == FactorStatus::ok) {
    NearNullTracker tracker;
    Matrix columns = tracker.right_hand_sides(one.weights);
    ldlt.solve(columns);
    const NearNull nearest = tracker.advance(one.weights, columns);
    if (const auto negative = negative_by_pivots(ldlt, one.weights, nearest)) {
      by_pivots = true;
      return SignCount{.negative = *negative, .positive = one.A.rows() - *negative, .undecided = 0};
    }
  }
  return sign_count_near_singularity(K, one.weights, one.multipliers);
}

}  // namespace

// An eigenvalue of the dense matrix is sure to a few n ε ‖A‖. Those above this are classified without an exception, and
// none of them is called undecided: what is, lies within ε |v|ᵀ |A| |v| of zero, which is less.
TEST(TestFunction, SignsOfTenThousandSystemsAreThoseOfTheDenseEigenvaluesSlow) {
  Numbers numbers(11);
  constexpr int cases = 10'000;
  int by_psi = 0, undecided = 0;
  for (int which = 0; which < cases; ++which) {
    const Case one = random_case(which, numbers);
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(one.A, Eigen::EigenvaluesOnly).eigenvalues();
    const double unsure = 4.0 * double(values.size()) * epsilon * values.cwiseAbs().maxCoeff();
    const Index negative = (values.array() < -unsure).count(), positive = (values.array() > unsure).count();
    bool by_pivots = false;
    const auto count = counted(one, by_pivots);
    ASSERT_TRUE(count.has_value()) << "case " << which;
    EXPECT_GE(count->negative, negative) << "case " << which;
    EXPECT_GE(count->positive, positive) << "case " << which;
    EXPECT_EQ(count->negative + count->positive + count->undecided, values.size());
    EXPECT_LE(count->undecided, values.size() - negative - positive) << "case " << which;
    by_psi += by_pivots ? 0 : 1;
    undecided += count->undecided > 0 ? 1 : 0;
  }
  // Each of the three answers was asked for often enough.
  EXPECT_GT(by_psi, cases / 20);
  EXPECT_LT(by_psi, cases / 2);
  EXPECT_GT(undecided, cases / 100);
}

// Aᵀ D A of small integers is exact, and singular exactly as often as D has zeros. (Definite but for the last unknown,
// which stands alone: an elimination without pivoting does not meet zeros on its way, as it does not in structures.)
TEST(TestFunction, EigenvaluesThatAreExactlyZeroAreUndecided) {
  Numbers numbers(12);
  for (const Index zeros : {1, 2, 3}) {
    for (int which = 0; which < 100; ++which) {
      const Index n = between(5, 12, numbers);
      Matrix A = Matrix::Identity(n, n);
      for (Index i = 0; i + 1 < n; ++i)
        for (Index j = 0; j < i; ++j) A(i, j) = double(between(-1, 1, numbers));
      Vector D(n);
      for (Index i = 0; i < n; ++i) D[i] = i < zeros ? 0.0 : i + 1 == n ? -2.0 : 1.0;
      const auto count =
          sign_count_near_singularity(lower_triangle(A.transpose() * D.asDiagonal() * A), Vector::Ones(n), 0);
      ASSERT_TRUE(count.has_value());
      EXPECT_EQ(count->undecided, zeros);
      EXPECT_EQ(count->negative, 1);
    }
  }
}

TEST(TestFunction, AMatrixOfZerosHasNoCount) {
  EXPECT_FALSE(sign_count_near_singularity(lower_triangle(Matrix::Zero(3, 3), -1.0), Vector::Ones(3), 0).has_value());
}

// [k 1; 1 0][v; ψ] = [0; 1]: v = 1, ψ = −k.
TEST(TestFunction, PsiOfOneUnknownIsMinusItsStiffness) {
  for (const double k : {3.0, 1e-12, 0.0, -1e-12, -3.0}) {
    const auto function = BorderedTestFunction::of(lower_triangle(Matrix::Constant(1, 1, k), -1.0), Matrix::Ones(1, 1));
    ASSERT_TRUE(function.has_value());
    EXPECT_DOUBLE_EQ(function->psi()(0, 0), -k);
    EXPECT_DOUBLE_EQ(function->vectors()(0, 0), 1.0);
  }
}

// K = Q diag(s, 2 s, 1, 1, …) Qᵀ with the first two columns of Q as the border: V = these, Ψ = −diag(s, 2 s), from one
// side of the singularity to the other.
TEST(TestFunction, PsiOfADoublePointPassesZeroSmoothly) {
  Numbers numbers(13);
  constexpr Index n = 20;
  const Matrix Q = orthogonal(n, numbers);
  for (const double s : {1e-2, 1e-9, 0.0, -1e-9, -1e-2}) {
    Vector values = Vector::Ones(n);
    values[0] = s;
    values[1] = 2.0 * s;
    const Matrix K = symmetric(Q * values.asDiagonal() * Q.transpose());
    const auto function = BorderedTestFunction::of(lower_triangle(K), Q.leftCols(2));
    ASSERT_TRUE(function.has_value());
    EXPECT_LE((function->psi() + Matrix(values.head(2).asDiagonal())).norm(), double(n) * epsilon);
    EXPECT_LE((function->vectors() - Q.leftCols(2)).norm(), 10.0 * double(n) * epsilon);
  }
}

TEST(TestFunction, ABorderNormalToTheNullSpaceIsRefused) {
  const Matrix K = Vector{{0.0, 1.0}}.asDiagonal();
  EXPECT_FALSE(BorderedTestFunction::of(lower_triangle(K), Vector::Unit(2, 1)).has_value());
}

// Terms of 1 that cancel leave 2⁻⁶⁰, which a sum with doubles loses.
TEST(TestFunction, QuadraticFormsKeepTheirDigits) {
  const double small = std::ldexp(1.0, -60);
  const Matrix K{{1.0, 0.0, 0.0}, {0.0, small, 0.0}, {0.0, 0.0, -1.0}};
  const QuadraticForm form = quadratic_form(lower_triangle(K), Vector::Ones(3));
  EXPECT_EQ(form.value, small);
  EXPECT_DOUBLE_EQ(form.roundoff, 2.0 * epsilon);
  const Matrix A{{2.0, -3.0}, {-3.0, 5.0}};  // 2·4 + 2·(−3)(−2)(7) + 5·49
  EXPECT_DOUBLE_EQ(quadratic_form(lower_triangle(A), Vector{{-2.0, 7.0}}).value, 8.0 + 84.0 + 245.0);
}

// Entries are summed in groups, whose number need not divide theirs; integers are summed exactly.
TEST(TestFunction, QuadraticFormsHaveAllEntries) {
  for (const Index n : {1, 2, 7, 15, 16, 31, 40}) {
    const Matrix A = Matrix::NullaryExpr(n, n, [](Index i, Index j) { return double((i * j + i + j) % 7 - 3); });
    const Vector v = Vector::NullaryExpr(n, [](Index i) { return double(i % 5 - 2); });
    const QuadraticForm form = quadratic_form(lower_triangle(A), v);
    EXPECT_EQ(form.value, v.dot(A * v)) << n;
    EXPECT_EQ(form.roundoff, epsilon * v.cwiseAbs().dot(A.cwiseAbs() * v.cwiseAbs())) << n;
  }
}

}  // namespace arcwall::test_function_test
