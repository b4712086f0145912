#include "core/algebra/block_tridiagonal/held_chain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/dense.hpp"

namespace arcwall::held_chain_test {

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

void expect_factors(HeldChain& factors, const Matrix& K, Index multipliers, Numbers& numbers) {
  const SparseMatrix lower = pattern_of(K, multipliers);
  ASSERT_TRUE(factors.factorize(lower));
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

TEST(HeldChain, InertiaAndSolutionsAreThoseOfTheDenseMatrix) {
  Numbers numbers(21);
  for (const double shift : {0.0, 3.0, 20.0})
    for (std::size_t h = 0; h < holds.size(); ++h) {
      SCOPED_TRACE("shift " + std::to_string(shift) + ", hold " + std::to_string(h));
      const auto m = static_cast<Index>(holds[h].size());
      const Matrix K = with_contacts(chain(8, shift, numbers), holds[h], numbers);
      const SparseMatrix lower = pattern_of(K, m);
      const auto groups = chain_groups(lower, m, 3);
      ASSERT_TRUE(groups);
      const auto factors = HeldChain::of(lower, m, *groups);
      ASSERT_TRUE(factors);
      expect_factors(*factors, K, m, numbers);
    }
}

// The structure alone is a mechanism.
TEST(HeldChain, ServesWhatIsHeldByItsContactsAlone) {
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
  const auto factors = HeldChain::of(lower, 1, chain_groups(lower, 1, 3).value());
  ASSERT_TRUE(factors);
  expect_factors(*factors, K, 1, numbers);
}

TEST(HeldChain, KeepsItsLayoutWhenContactsChange) {
  Numbers numbers(23);
  const Matrix A = chain(8, 3.0, numbers);
  const SparseMatrix first = pattern_of(with_contacts(A, {{1}}, numbers), 1);
  const auto factors = HeldChain::of(first, 1, chain_groups(first, 1, 3).value());
  ASSERT_TRUE(factors);
  for (std::size_t h = 0; h < holds.size(); ++h) {
    SCOPED_TRACE(h);
    const auto m = static_cast<Index>(holds[h].size());
    const Matrix K = with_contacts(A, holds[h], numbers);
    ASSERT_TRUE(factors->adopts(pattern_of(K, m), m));
    expect_factors(*factors, K, m, numbers);
  }
  EXPECT_TRUE(factors->adopts(lower_triangle(A), 0));
  expect_factors(*factors, A, 0, numbers);
  EXPECT_FALSE(factors->adopts(lower_triangle(chain(9, 3.0, numbers)), 0));
  Matrix less = A;
  less(4, 3) = less(3, 4) = 0.0;
  EXPECT_FALSE(factors->adopts(lower_triangle(less), 0));
}

TEST(HeldChain, LeavesMultipliersOfSeveralNodesToOthers) {
  Numbers numbers(24);
  Matrix K = with_contacts(chain(5, 3.0, numbers), {{2}}, numbers);
  K(15, 9) = K(9, 15) = 0.4;  // and node 3
  const SparseMatrix lower = pattern_of(K, 1);
  EXPECT_FALSE(HeldChain::of(lower, 1, chain_groups(lower, 1, 3).value()));
}

TEST(HeldChain, TwoMultipliersThatHoldTheSameAreSingular) {
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
  const auto factors = HeldChain::of(lower, 2, chain_groups(lower, 2, 3).value());
  ASSERT_TRUE(factors);
  EXPECT_FALSE(factors->factorize(lower));
}

// Wherever it stands.
TEST(HeldChain, AnEntryThatIsNotFiniteIsSeen) {
  Numbers numbers(26);
  const Matrix K = with_contacts(chain(5, 3.0, numbers), {{1}, {2}, {2}, {4, 0.5}}, numbers);
  const SparseMatrix lower = pattern_of(K, 4);
  const auto factors = HeldChain::of(lower, 4, chain_groups(lower, 4, 3).value());
  ASSERT_TRUE(factors);
  for (const double bad : {infinity, std::numeric_limits<double>::quiet_NaN()})
    for (Index entry = 0; entry < lower.nonZeros(); ++entry) {
      SparseMatrix spoiled = lower;
      spoiled.valuePtr()[entry] = bad;
      EXPECT_FALSE(factors->factorize(spoiled)) << "entry " << entry;
    }
}

}  // namespace arcwall::held_chain_test
