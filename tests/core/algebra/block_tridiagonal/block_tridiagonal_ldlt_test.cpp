#include "core/algebra/block_tridiagonal/block_tridiagonal_ldlt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/algebra/ldlt.hpp"
#include "tests/core/algebra/block_tridiagonal/beam.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::block_tridiagonal_ldlt_test {

namespace {

using test::Beam;
using test::lower_triangle;
using test::Numbers;

// A chain of nodes with `degrees of freedom` unknowns each, numbered at random; indefinite.
Matrix chain(Index nodes, Index dofs, Numbers& numbers) {
  const Index n = nodes * dofs;
  std::vector<Index> place(static_cast<std::size_t>(nodes));
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t k = place.size(); k > 1; --k)
    std::swap(place[k - 1], place[static_cast<std::size_t>(0.4999 * (numbers() + 1.0) * double(k))]);
  const auto first = [&](Index node) { return dofs * place[static_cast<std::size_t>(node)]; };
  Matrix A = Matrix::Zero(n, n);
  for (Index node = 0; node < nodes; ++node) {
    const Matrix block = numbers.matrix(dofs, dofs);
    A.block(first(node), first(node), dofs, dofs) = block + block.transpose();
    A.diagonal().segment(first(node), dofs) += numbers.vector(dofs) * 4.0;
    if (node + 1 == nodes) continue;
    const Matrix coupling = numbers.matrix(dofs, dofs);
    A.block(first(node), first(node + 1), dofs, dofs) = coupling;
    A.block(first(node + 1), first(node), dofs, dofs) = coupling.transpose();
  }
  return A;
}

Index negative(const Matrix& A) {
  return (Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues().array() < 0.0).count();
}

// The order of cyclic reduction: every second group, then every second of those left, up to one, which is given back.
std::vector<Index> reduce(Blocks left, std::vector<Index>& order) {
  while (left.size() > 1) {
    Blocks next;
    for (std::size_t g = 0; g < left.size(); ++g)
      if (g % 2 == 1)
        order.insert(order.end(), left[g].begin(), left[g].end());
      else
        next.push_back(left[g]);
    left = std::move(next);
  }
  return left.front();
}

// |v|ᵀ |L| |D| |L|ᵀ |v| of a dense L D Lᵀ in the order in which four stretches of a chain are reduced, then what they
// leave.
double weighted(const Matrix& A, const Blocks& groups, const Vector& v) {
  const auto length = static_cast<std::ptrdiff_t>((groups.size() + 3) / 4);
  std::vector<Index> order;
  Blocks left;
  for (auto from = groups.begin(); from != groups.end();) {
    const auto to = from + std::min(length, groups.end() - from);
    left.push_back(reduce({from, to}, order));
    from = to;
  }
  const std::vector<Index> last = reduce(left, order);
  order.insert(order.end(), last.begin(), last.end());
  Matrix rest = A(order, order);
  const Vector size = v(order).cwiseAbs();
  double sum = 0.0;
  for (Index j = 0; j < rest.cols(); ++j) {
    const Index behind = rest.cols() - j - 1;
    const double pivot = rest(j, j);
    const Vector column = rest.col(j).tail(behind) / pivot;
    rest.bottomRightCorner(behind, behind) -= pivot * column * column.transpose();
    sum += std::abs(pivot) * std::pow(size[j] + column.cwiseAbs().dot(size.tail(behind)), 2);
  }
  return sum;
}

}  // namespace

TEST(BlockTridiagonalLdlt, GroupsOfAChainAreItsNodes) {
  Numbers numbers(11);
  for (const Index dofs : {1, 2, 3, 5})
    for (const Index nodes : {1, 3, 4, 7, 40}) {
      const auto groups = find_blocks(lower_triangle(chain(nodes, dofs, numbers)), 0, dofs);
      ASSERT_TRUE(groups) << nodes << " nodes of " << dofs;
      EXPECT_EQ(static_cast<Index>(groups->size()), nodes);
    }
}

// A ring is a chain of pairs, and a star of three arms one of threes.
TEST(BlockTridiagonalLdlt, WhatIsWiderThanAChainIsOneOfWiderGroupsOrNone) {
  Matrix ring = Matrix::Identity(12, 12);
  for (Index i = 0; i < 12; ++i) ring(i, (i + 1) % 12) = ring((i + 1) % 12, i) = 0.3;
  EXPECT_FALSE(find_blocks(lower_triangle(ring), 0, 1));
  ASSERT_TRUE(find_blocks(lower_triangle(ring), 0, 2));
  EXPECT_EQ(find_blocks(lower_triangle(ring), 0, 2)->size(), 7U);
  const Matrix all = Matrix::Ones(9, 9);
  EXPECT_FALSE(find_blocks(lower_triangle(all), 0, 8));
}

TEST(BlockTridiagonalLdlt, PartsOfAChainNeedNotHangTogether) {
  Matrix A = Matrix::Zero(7, 7);
  A.diagonal() << 2.0, 3.0, -1.0, 4.0, 5.0, 1.0, 2.0;
  A(4, 1) = A(1, 4) = 1.0;
  A(6, 4) = A(4, 6) = -1.0;
  A(5, 0) = A(0, 5) = 0.5;
  const SparseMatrix lower = lower_triangle(A);
  const auto groups = find_blocks(lower, 0, 3);
  ASSERT_TRUE(groups);
  BlockTridiagonalLdlt ldlt(lower, *groups);
  ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
  EXPECT_EQ(ldlt.pivots().signs.negative, 1);
  Matrix X = A * Matrix::Identity(7, 7);
  ldlt.solve(X);
  EXPECT_LE((X - Matrix::Identity(7, 7)).norm(), 1e-14);
}

TEST(BlockTridiagonalLdlt, InertiaAndSolutionsOfIndefiniteChainsAreThoseOfTheDenseOnes) {
  Numbers numbers(12);
  for (const Index dofs : {1, 2, 3, 4, 5, 6})
    for (const Index nodes : {1, 3, 4, 5, 30, 64}) {
      SCOPED_TRACE(std::to_string(nodes) + " nodes of " + std::to_string(dofs));
      const Matrix A = chain(nodes, dofs, numbers);
      const SparseMatrix lower = lower_triangle(A);
      const Blocks groups = find_blocks(lower, 0, BlockTridiagonalLdlt::widest).value();
      BlockTridiagonalLdlt ldlt(lower, groups);
      ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
      EXPECT_EQ(ldlt.pivots().signs.negative, negative(A));
      EXPECT_EQ(ldlt.pivots().signs.positive, A.cols() - negative(A));
      const double growth = ldlt.pivots().greatest / ldlt.pivots().least;
      for (const Index columns : {1, 2, 3, 4, 7}) {
        const Matrix expected = numbers.matrix(A.cols(), columns);
        Matrix X = A * expected;
        ldlt.solve(X);
        EXPECT_LE((X - expected).norm(), 1e-13 * growth * double(A.cols()) * expected.norm());
      }
      const Vector v = numbers.vector(A.cols());
      const double expected = weighted(A, groups, v);
      EXPECT_NEAR(ldlt.weighted(v), expected, 1e-13 * growth * double(A.cols()) * expected);
      EXPECT_GE(expected, std::abs(v.dot(A * v)));
    }
}

// Wherever it stands: so that the entries need not be looked at one by one.
TEST(BlockTridiagonalLdlt, AnEntryThatIsNotFiniteIsSeen) {
  Numbers numbers(6);
  for (const Index nodes : {1, 2, 5, 12}) {
    SparseMatrix lower = lower_triangle(chain(nodes, 2, numbers));
    BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 4).value());
    for (Index i = 0; i < lower.nonZeros(); ++i)
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
        const double good = std::exchange(lower.valuePtr()[i], bad);
        EXPECT_EQ(ldlt.factorize(lower), FactorStatus::not_finite) << nodes << " nodes, value " << i << " is " << bad;
        lower.valuePtr()[i] = good;
      }
    EXPECT_EQ(ldlt.factorize(lower), FactorStatus::ok);
  }
}

TEST(BlockTridiagonalLdlt, AZeroPivotIsSeen) {
  const SparseMatrix A = lower_triangle(Matrix{{0.0, 1.0}, {1.0, 0.0}});
  BlockTridiagonalLdlt ldlt(A, Blocks{{0, 1}});
  EXPECT_EQ(ldlt.factorize(A), FactorStatus::singular);
}

// Every second node goes first: with δ on the diagonal of one of these, what is left of its neighbours is of the order
// 1/δ, and nothing of their own is seen beside that. From the ends, as minimum degree goes, nothing grows.
TEST(BlockTridiagonalLdlt, RefusesAMatrixOfWhichAPartIsSingularAndAnotherOrderServes) {
  for (const Index nodes : {5, 9, 33})
    for (const double delta : {1e-3, 1e-8, -1e-14}) {
      Matrix A = 2.0 * Matrix::Identity(nodes, nodes);
      A.diagonal(1).setConstant(-0.9);
      A.diagonal(-1).setConstant(-0.9);
      const Blocks groups = find_blocks(lower_triangle(A), 0, BlockTridiagonalLdlt::widest).value();
      A(groups[1][0], groups[1][0]) = delta;
      const SparseMatrix lower = lower_triangle(A);
      BlockTridiagonalLdlt alone(lower, groups);
      EXPECT_EQ(alone.factorize(lower), delta == 1e-3 ? FactorStatus::ok : FactorStatus::singular);
      EXPECT_EQ(alone.refused(), delta != 1e-3);
      Ldlt ldlt;
      ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
      EXPECT_EQ(ldlt.inertia()->negative, negative(A));
      Matrix x = A * Vector::LinSpaced(nodes, 1.0, 2.0);
      ldlt.solve(x);
      EXPECT_LE((x - Vector::LinSpaced(nodes, 1.0, 2.0)).cwiseAbs().maxCoeff(), 1e-12) << delta;
    }
}

// On two supports under a force of 1 in its middle, which goes down by 1/48. Entries are n⁴ times as great as what they
// leave to resist the whole, 10¹⁸ here.
TEST(BlockTridiagonalLdlt, KnowsThatNothingHoldsWhatIsAfloatHoweverFineTheMesh) {
  const Beam beam(30000, {0, 8});
  const SparseMatrix& lower = beam.lower;
  const Index middle = beam.deflection(4);
  const Vector bending = Vector::Unit(lower.cols(), middle);

  BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 3).value(), beam.translation_free);
  ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
  EXPECT_EQ(ldlt.pivots().signs.negative, 0);
  Matrix w = bending;
  ldlt.solve(w);
  EXPECT_NEAR(w(middle, 0), 1.0 / 48.0, 1e-6 / 48.0);
  // Nothing but round-off of what bends stands beside the energy of the deflected beam, which is that of the force.
  EXPECT_LE(std::numeric_limits<double>::epsilon() * ldlt.weighted(w), 1e-4 * w(middle, 0));

  BlockTridiagonalLdlt held(lower, find_blocks(lower, 0, 3).value());
  w = bending;
  if (held.factorize(lower) == FactorStatus::ok) held.solve(w);
  EXPECT_GT(std::abs(48.0 * w(middle, 0) - 1.0), 0.1);
}

// Wherever the supports are: parts between them are translation_free, and what lies beside a support is not. By eight
// elements.
TEST(BlockTridiagonalLdlt, KnowsBetweenSupportsToo) {
  for (const std::vector<Index>& supports : std::vector<std::vector<Index>>{{0, 3, 8}, {2, 4, 6}, {0, 1, 7}, {5, 8}}) {
    const Beam coarse(8, supports), fine(30000, supports);
    const Index from = supports[0] == 0 ? 2 : 0;
    const Matrix dense = Matrix(coarse.lower).selfadjointView<Eigen::Lower>();
    const Vector expected = dense.ldlt().solve(Vector::Unit(dense.cols(), coarse.deflection(from)));
    BlockTridiagonalLdlt ldlt(fine.lower, find_blocks(fine.lower, 0, 3).value(), fine.translation_free);
    ASSERT_EQ(ldlt.factorize(fine.lower), FactorStatus::ok);
    EXPECT_EQ(ldlt.pivots().signs.negative, 0);
    Matrix w = Vector::Unit(fine.lower.cols(), fine.deflection(from));
    ldlt.solve(w);
    for (Index at = 0; at <= 8; ++at)
      if (coarse.deflection(at) >= 0) {
        EXPECT_NEAR(w(fine.deflection(at), 0), expected[coarse.deflection(at)], 1e-6 * expected.cwiseAbs().maxCoeff())
            << "at " << at << "/8";
      }
  }
}

// Of a beam on two supports with 60000 elements, bent and pulled at once.
TEST(BlockTridiagonalLdlt, SolvesForTwoColumnsOfALongChain) {
  const Beam beam(60000, {0, 8});
  const SparseMatrix& lower = beam.lower;
  const Index middle = beam.deflection(4), end = lower.cols() - 2;
  BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 3).value(), beam.translation_free);
  Matrix Y(lower.cols(), 2);
  Y << Vector::Unit(lower.cols(), middle), Vector::Unit(lower.cols(), end);
  ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
  ldlt.solve(Y);
  EXPECT_NEAR(48.0 * Y(middle, 0), 1.0, 1e-5);
  EXPECT_NEAR(12.0 * Y(end, 1), 1.0, 1e-5);  // EA = 12
}

// A spring k in the middle of a beam on two supports shares the force with the beam: w = 1/(48 + k). Entries of K are
// 10¹⁵ times as great, so that K alone has lost it.
TEST(BlockTridiagonalLdlt, AStiffnessToGroundKeepsItsDigits) {
  const Beam beam(40000, {0, 8});
  const Index middle = beam.deflection(4);
  for (const double k : {3.0, 48.0, 1e5}) {
    SparseMatrix lower = beam.lower;
    lower.coeffRef(middle, middle) += k;
    const std::vector<GroundTerm> ground{{.row = middle, .column = middle, .stiffness = k}};
    BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 3).value(), beam.translation_free);
    Matrix w = Vector::Unit(lower.cols(), middle);
    ASSERT_EQ(ldlt.factorize(lower, {.ground = ground}), FactorStatus::ok);
    ldlt.solve(w);
    EXPECT_NEAR((48.0 + k) * w(middle, 0), 1.0, 1e-6) << k;
  }
}

// A beam without supports in z stands on two springs k at its ends and is held in x by a third one: under a force of 1
// in the middle it goes down by 1/48 + 1/(2k) there.
TEST(BlockTridiagonalLdlt, SpringsAloneHoldAStructure) {
  const Beam beam(40000, {});
  const Index middle = beam.deflection(4), ends[]{beam.deflection(0), beam.deflection(8)};
  const double k = 20.0;
  SparseMatrix lower = beam.lower;
  std::vector<GroundTerm> ground;
  for (const Index at : {ends[0] - 1, ends[0], ends[1]}) {
    lower.coeffRef(at, at) += k;
    ground.push_back({.row = at, .column = at, .stiffness = k});
  }
  BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 3).value(), beam.translation_free);
  Matrix X(lower.cols(), 2);
  X << Vector::Unit(lower.cols(), middle), Vector::Unit(lower.cols(), ends[1] - 1);
  ASSERT_EQ(ldlt.factorize(lower, {.ground = ground}), FactorStatus::ok);
  EXPECT_EQ(ldlt.pivots().signs.negative, 0);
  ldlt.solve(X);
  const double expected = 1.0 / 48.0 + 0.5 / k;
  EXPECT_NEAR(X(middle, 0) / expected, 1.0, 1e-6);
  EXPECT_NEAR(X(ends[1] - 1, 1), 1.0 / 12.0 + 1.0 / k, 1e-6);  // EA = 12
}

TEST(BlockTridiagonalLdlt, NothingIsLeftOfASingularMatrix) {
  Numbers numbers(14);
  for (const Index nodes : {1, 4, 5, 6, 7, 8, 30}) {
    SCOPED_TRACE(nodes);
    const Matrix A = chain(nodes, 3, numbers);
    Matrix zero_pivots = A;
    for (Index node = 0; node < nodes; ++node) zero_pivots.block(3 * node, 3 * node, 3, 3).setZero();
    const SparseMatrix lower = lower_triangle(A);
    SparseMatrix singular = lower;
    for (Index column = 0; column < singular.cols(); ++column)
      for (SparseMatrix::InnerIterator entry(singular, column); entry; ++entry)
        entry.valueRef() = zero_pivots(entry.row(), column);
    BlockTridiagonalLdlt ldlt(lower, find_blocks(lower, 0, 3).value());
    EXPECT_EQ(ldlt.factorize(singular), FactorStatus::singular);
    ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
    Matrix X = A;
    ldlt.solve(X);
    EXPECT_LE((X - Matrix::Identity(A.rows(), A.cols())).norm(), 1e-8);
  }
}

// A contact at each of some nodes: K of a chain, a multiplier for each contact.
TEST(Ldlt, SolvesChainsWithMultipliers) {
  Numbers numbers(13);
  for (const Index contacts : {1, 5, 20}) {
    SCOPED_TRACE(contacts);
    const Index nodes = 20, dofs = 3, n = nodes * dofs;
    Matrix A = Matrix::Zero(n + contacts, n + contacts);
    A.topLeftCorner(n, n) = chain(nodes, dofs, numbers) + 20.0 * Matrix::Identity(n, n);
    for (Index j = 0; j < contacts; ++j) {
      const Vector gradient = numbers.vector(dofs);
      A.block(n + j, dofs * (j * nodes / contacts), 1, dofs) = -gradient.transpose();
      A.block(dofs * (j * nodes / contacts), n + j, dofs, 1) = -gradient;
    }
    const SparseMatrix lower = lower_triangle(A);
    Ldlt ldlt;
    ASSERT_EQ(ldlt.factorize(lower, {.multipliers = contacts}), FactorStatus::ok);
    EXPECT_EQ(ldlt.inertia()->negative, contacts);
    const Matrix expected = numbers.matrix(A.cols(), 3);
    Matrix X = A * expected;
    ldlt.solve(X);
    EXPECT_LE((X - expected).norm(), 1e-10 * expected.norm());
  }
}

}  // namespace arcwall::block_tridiagonal_ldlt_test
