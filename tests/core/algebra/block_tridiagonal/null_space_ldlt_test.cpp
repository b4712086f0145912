#include "core/algebra/block_tridiagonal/null_space_ldlt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <string>
#include <vector>

#include "core/algebra/ldlt.hpp"
#include "tests/core/algebra/block_tridiagonal/beam.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::null_space_ldlt_test {

namespace {

using test::lower_triangle;
using test::Numbers;

// A chain of nodes with three unknowns each, one after the other.
Matrix chain(Index nodes, double shift, Numbers& numbers) {
  Matrix A = Matrix::Zero(3 * nodes, 3 * nodes);
  for (Index node = 0; node < nodes; ++node) {
    const Matrix block = numbers.matrix(3, 3);
    A.block(3 * node, 3 * node, 3, 3) = block + block.transpose() + shift * Matrix::Identity(3, 3);
    if (node + 1 == nodes) continue;
    const Matrix coupling = numbers.matrix(3, 3);
    A.block(3 * node, 3 * node + 3, 3, 3) = coupling;
    A.block(3 * node + 3, 3 * node, 3, 3) = coupling.transpose();
  }
  return A;
}

// One multiplier of a node; c: its compliance.
struct Contact {
  Index node;
  double c = 0.0;
};

Matrix with_contacts(const Matrix& A, const std::vector<Contact>& contacts, Numbers& numbers) {
  const Index n = A.cols(), m = static_cast<Index>(contacts.size());
  Matrix K = Matrix::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = A;
  for (Index j = 0; j < m; ++j) {
    const auto [node, c] = contacts[static_cast<std::size_t>(j)];
    K.block(n + j, 3 * node, 1, 3) = numbers.vector(3).transpose();
    K.block(3 * node, n + j, 3, 1) = K.block(n + j, 3 * node, 1, 3).transpose();
    K(n + j, n + j) = -c;
  }
  return K;
}

// Multipliers keep their place on the diagonal where it is zero.
SparseMatrix pattern_of(const Matrix& K, Index multipliers) {
  Matrix marked = K;
  for (Index j = K.cols() - multipliers; j < K.cols(); ++j)
    if (marked(j, j) == 0.0) marked(j, j) = 1.0;
  SparseMatrix lower = lower_triangle(marked);
  for (Index j = K.cols() - multipliers; j < K.cols(); ++j) lower.coeffRef(j, j) = K(j, j);
  return lower;
}

void expect_factors(NullSpaceLdlt& factors, const Matrix& K, Index multipliers, Numbers& numbers) {
  const SparseMatrix lower = pattern_of(K, multipliers);
  ASSERT_EQ(factors.factorize(lower), FactorStatus::ok);
  const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues();
  const double condition = eigenvalues.cwiseAbs().maxCoeff() / eigenvalues.cwiseAbs().minCoeff();
  EXPECT_EQ(factors.pivots().signs.negative, (eigenvalues.array() < 0.0).count());
  EXPECT_EQ(factors.pivots().signs.positive, (eigenvalues.array() > 0.0).count());
  for (const Index columns : {1, 2, 5}) {
    const Matrix expected = numbers.matrix(K.cols(), columns);
    Matrix X = K * expected;
    factors.solve(X);
    EXPECT_LE((X - expected).norm(), 1e-14 * condition * expected.norm());
  }
  const Vector v = numbers.vector(K.cols());
  EXPECT_GE(factors.weighted(v), std::abs(v.dot(K * v)) * (1.0 - 1e-12));
}

const std::vector<std::vector<Contact>> holds{
    {{0}},
    {{7}},
    {{3}, {4}},                                 // beside each other
    {{2}, {2}, {5}},                            // two at one node
    {{6}, {6}, {6}, {0}},                       // all of a node
    {{4, 0.3}},                                 // a spring
    {{4, 1e-9}, {5, 1e3}},                      // a stiff one beside a soft one
    {{1, 0.2}, {1}, {1, 0.7}, {2}, {2, 1e-3}},  // both at one node
};

}  // namespace

TEST(NullSpaceLdlt, InertiaAndSolutionsAreThoseOfTheDenseMatrix) {
  Numbers numbers(21);
  for (const double shift : {0.0, 3.0, 20.0})
    for (std::size_t h = 0; h < holds.size(); ++h) {
      SCOPED_TRACE("shift " + std::to_string(shift) + ", hold " + std::to_string(h));
      const auto m = static_cast<Index>(holds[h].size());
      const Matrix K = with_contacts(chain(8, shift, numbers), holds[h], numbers);
      const SparseMatrix lower = pattern_of(K, m);
      const auto groups = find_blocks(lower, m, 3);
      ASSERT_TRUE(groups);
      const auto factors = NullSpaceLdlt::of(lower, m, *groups);
      ASSERT_TRUE(factors);
      expect_factors(*factors, K, m, numbers);
    }
}

// The structure alone is a mechanism.
TEST(NullSpaceLdlt, ServesWhatIsHeldByItsContactsAlone) {
  Numbers numbers(22);
  const Index nodes = 6, n = 3 * nodes;
  const Matrix motion = numbers.matrix(n, 1).normalized();
  Matrix A = Matrix::Zero(n, n);
  for (Index node = 0; node + 1 < nodes; ++node) {  // each element knows nothing of the motion
    Vector here = motion.col(0).segment(3 * node, 6).normalized();
    const Matrix rest = Matrix::Identity(6, 6) - here * here.transpose();
    A.block(3 * node, 3 * node, 6, 6) +=
        rest * (3.0 * Matrix::Identity(6, 6) + numbers.matrix(6, 1).asDiagonal().toDenseMatrix()) * rest;
  }
  const Matrix K = with_contacts(A, {{2}}, numbers);
  const SparseMatrix lower = pattern_of(K, 1);
  const auto factors = NullSpaceLdlt::of(lower, 1, find_blocks(lower, 1, 3).value());
  ASSERT_TRUE(factors);
  expect_factors(*factors, K, 1, numbers);
}

TEST(NullSpaceLdlt, KeepsItsLayoutWhenContactsChange) {
  Numbers numbers(23);
  const Matrix A = chain(8, 3.0, numbers);
  const SparseMatrix first = pattern_of(with_contacts(A, {{1}}, numbers), 1);
  const auto factors = NullSpaceLdlt::of(first, 1, find_blocks(first, 1, 3).value());
  ASSERT_TRUE(factors);
  for (std::size_t h = 0; h < holds.size(); ++h) {
    SCOPED_TRACE(h);
    const auto m = static_cast<Index>(holds[h].size());
    const Matrix K = with_contacts(A, holds[h], numbers);
    ASSERT_TRUE(factors->reuse_analysis(pattern_of(K, m), m));
    expect_factors(*factors, K, m, numbers);
  }
  EXPECT_TRUE(factors->reuse_analysis(lower_triangle(A), 0));
  expect_factors(*factors, A, 0, numbers);
  EXPECT_FALSE(factors->reuse_analysis(lower_triangle(chain(9, 3.0, numbers)), 0));
  Matrix less = A;
  less(4, 3) = less(3, 4) = 0.0;
  EXPECT_FALSE(factors->reuse_analysis(lower_triangle(less), 0));
}

TEST(NullSpaceLdlt, LeavesMultipliersOfSeveralNodesToOthers) {
  Numbers numbers(24);
  Matrix K = with_contacts(chain(5, 3.0, numbers), {{2}}, numbers);
  K(15, 9) = K(9, 15) = 0.4;  // and node 3
  const SparseMatrix lower = pattern_of(K, 1);
  EXPECT_FALSE(NullSpaceLdlt::of(lower, 1, find_blocks(lower, 1, 3).value()));
}

TEST(NullSpaceLdlt, TwoMultipliersThatHoldTheSameAreSingular) {
  Numbers numbers(25);
  Matrix K = with_contacts(chain(5, 3.0, numbers), {{2}, {2}}, numbers);
  K.row(16).head(15) = K.row(15).head(15) = (Vector::Unit(15, 7) * 2.0).transpose();
  K.col(16).head(15) = K.col(15).head(15) = Vector::Unit(15, 7) * 2.0;
  Matrix marked = K;
  for (Index unknown = 6; unknown < 9; ++unknown) marked(15, unknown) = marked(16, unknown) = 1.0;
  SparseMatrix lower = pattern_of(marked, 2);
  for (Index column = 0; column < lower.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
      entry.valueRef() = K(entry.row(), entry.col());
  const auto factors = NullSpaceLdlt::of(lower, 2, find_blocks(lower, 2, 3).value());
  ASSERT_TRUE(factors);
  EXPECT_EQ(factors->factorize(lower, {}), FactorStatus::singular);
}

// Wherever it stands.
TEST(NullSpaceLdlt, AnEntryThatIsNotFiniteIsSeen) {
  Numbers numbers(26);
  const Matrix K = with_contacts(chain(5, 3.0, numbers), {{1}, {2}, {2}, {4, 0.5}}, numbers);
  const SparseMatrix lower = pattern_of(K, 4);
  const auto factors = NullSpaceLdlt::of(lower, 4, find_blocks(lower, 4, 3).value());
  ASSERT_TRUE(factors);
  for (const double bad : {infinity, std::numeric_limits<double>::quiet_NaN()})
    for (Index entry = 0; entry < lower.nonZeros(); ++entry) {
      SparseMatrix spoiled = lower;
      spoiled.valuePtr()[entry] = bad;
      EXPECT_EQ(factors->factorize(spoiled, {}), FactorStatus::not_finite) << "entry " << entry;
    }
}

// A beam on two supports that is pressed against a third one in its middle, which gives way by c times its force, and
// is loaded by 1 at a quarter: without the third support the middle goes down by w = 0.6875/48, so its force is w/(1/48
// + c). Entries of K are 10¹⁵ times what resists the whole.
TEST(NullSpaceLdlt, AClosedContactOnAFineMeshKeepsItsDigits) {
  const test::Beam beam(40000, {0, 8});
  const Index n = beam.lower.cols(), middle = beam.deflection(4), quarter = beam.deflection(2);
  for (const double c : {0.0, 1e-17, 0.01, 3.0}) {
    SparseMatrix lower(n + 1, n + 1);
    std::vector<Eigen::Triplet<double, Index>> entries{{n, middle, 1.0}, {n, n, -c}};
    for (Index column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator entry(beam.lower, column); entry; ++entry)
        entries.emplace_back(entry.row(), column, entry.value());
    lower.setFromTriplets(entries.begin(), entries.end());
    std::vector<bool> translation_free = beam.translation_free;
    translation_free.push_back(false);
    Ldlt ldlt;
    ASSERT_EQ(ldlt.factorize(lower, {.multipliers = 1, .translation_free = &translation_free}), FactorStatus::ok);
    EXPECT_EQ(ldlt.inertia()->negative, 1);
    Matrix x = Vector::Unit(n + 1, quarter);
    ldlt.solve(x);
    const double w = 0.6875 / 48.0, force = w / (1.0 / 48.0 + c);
    EXPECT_NEAR(x(n, 0) / force, 1.0, 1e-6) << c;
    EXPECT_NEAR(x(quarter, 0), 9.0 / 768.0 - force * w, 1e-6 * 9.0 / 768.0) << c;
  }
}

}  // namespace arcwall::null_space_ldlt_test
