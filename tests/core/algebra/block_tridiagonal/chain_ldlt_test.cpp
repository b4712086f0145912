#include "core/algebra/block_tridiagonal/chain_ldlt.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/algebra/ldlt.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::chain_ldlt_test {

namespace {

using test::lower_triangle;
using test::Numbers;

// A chain of nodes with `freedoms` unknowns each, numbered at random; indefinite.
Matrix chain(Index nodes, Index freedoms, Numbers& numbers) {
  const Index n = nodes * freedoms;
  std::vector<Index> place(static_cast<std::size_t>(nodes));
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t k = place.size(); k > 1; --k)
    std::swap(place[k - 1], place[static_cast<std::size_t>(0.4999 * (numbers() + 1.0) * double(k))]);
  const auto first = [&](Index node) { return freedoms * place[static_cast<std::size_t>(node)]; };
  Matrix A = Matrix::Zero(n, n);
  for (Index node = 0; node < nodes; ++node) {
    const Matrix block = numbers.matrix(freedoms, freedoms);
    A.block(first(node), first(node), freedoms, freedoms) = block + block.transpose();
    A.diagonal().segment(first(node), freedoms) += numbers.vector(freedoms) * 4.0;
    if (node + 1 == nodes) continue;
    const Matrix coupling = numbers.matrix(freedoms, freedoms);
    A.block(first(node), first(node + 1), freedoms, freedoms) = coupling;
    A.block(first(node + 1), first(node), freedoms, freedoms) = coupling.transpose();
  }
  return A;
}

Index negative(const Matrix& A) {
  return (Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues().array() < 0.0).count();
}

// The order of cyclic reduction: every second group, then every second of those left, up to one, which is given back.
std::vector<Index> reduce(ChainGroups left, std::vector<Index>& order) {
  while (left.size() > 1) {
    ChainGroups next;
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
double weighted(const Matrix& A, const ChainGroups& groups, const Vector& v) {
  const auto length = static_cast<std::ptrdiff_t>((groups.size() + 3) / 4);
  std::vector<Index> order;
  ChainGroups left;
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

TEST(ChainLdlt, GroupsOfAChainAreItsNodes) {
  Numbers numbers(11);
  for (const Index freedoms : {1, 2, 3, 5})
    for (const Index nodes : {1, 3, 4, 7, 40}) {
      const auto groups = chain_groups(lower_triangle(chain(nodes, freedoms, numbers)), 0, freedoms);
      ASSERT_TRUE(groups) << nodes << " nodes of " << freedoms;
      EXPECT_EQ(static_cast<Index>(groups->size()), nodes);
    }
}

// A ring is a chain of pairs, and a star of three arms one of threes.
TEST(ChainLdlt, WhatIsWiderThanAChainIsOneOfWiderGroupsOrNone) {
  Matrix ring = Matrix::Identity(12, 12);
  for (Index i = 0; i < 12; ++i) ring(i, (i + 1) % 12) = ring((i + 1) % 12, i) = 0.3;
  EXPECT_FALSE(chain_groups(lower_triangle(ring), 0, 1));
  ASSERT_TRUE(chain_groups(lower_triangle(ring), 0, 2));
  EXPECT_EQ(chain_groups(lower_triangle(ring), 0, 2)->size(), 7U);
  const Matrix all = Matrix::Ones(9, 9);
  EXPECT_FALSE(chain_groups(lower_triangle(all), 0, 8));
}

TEST(ChainLdlt, PartsOfAChainNeedNotHangTogether) {
  Matrix A = Matrix::Zero(7, 7);
  A.diagonal() << 2.0, 3.0, -1.0, 4.0, 5.0, 1.0, 2.0;
  A(4, 1) = A(1, 4) = 1.0;
  A(6, 4) = A(4, 6) = -1.0;
  A(5, 0) = A(0, 5) = 0.5;
  const SparseMatrix lower = lower_triangle(A);
  const auto groups = chain_groups(lower, 0, 3);
  ASSERT_TRUE(groups);
  ChainLdlt ldlt(lower, *groups);
  ASSERT_TRUE(ldlt.factorize(lower));
  EXPECT_EQ(ldlt.pivots().signs.negative, 1);
  Matrix X = A * Matrix::Identity(7, 7);
  ldlt.solve(X);
  EXPECT_LE((X - Matrix::Identity(7, 7)).norm(), 1e-14);
}

TEST(ChainLdlt, InertiaAndSolutionsOfIndefiniteChainsAreThoseOfTheDenseOnes) {
  Numbers numbers(12);
  for (const Index freedoms : {1, 2, 3, 4, 5, 6, 8})
    for (const Index nodes : {1, 3, 4, 5, 30, 64}) {
      SCOPED_TRACE(std::to_string(nodes) + " nodes of " + std::to_string(freedoms));
      const Matrix A = chain(nodes, freedoms, numbers);
      const SparseMatrix lower = lower_triangle(A);
      const ChainGroups groups = chain_groups(lower, 0, ChainLdlt::widest).value();
      ChainLdlt ldlt(lower, groups);
      ASSERT_TRUE(ldlt.factorize(lower));
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
TEST(ChainLdlt, AnEntryThatIsNotFiniteIsSeen) {
  Numbers numbers(6);
  for (const Index nodes : {1, 2, 5, 12}) {
    SparseMatrix lower = lower_triangle(chain(nodes, 2, numbers));
    ChainLdlt ldlt(lower, chain_groups(lower, 0, 4).value());
    for (Index i = 0; i < lower.nonZeros(); ++i)
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
        const double good = std::exchange(lower.valuePtr()[i], bad);
        EXPECT_FALSE(ldlt.factorize(lower)) << nodes << " nodes, value " << i << " is " << bad;
        lower.valuePtr()[i] = good;
      }
    EXPECT_TRUE(ldlt.factorize(lower));
  }
}

TEST(ChainLdlt, AZeroPivotIsSeen) {
  const SparseMatrix A = lower_triangle(Matrix{{0.0, 1.0}, {1.0, 0.0}});
  ChainLdlt ldlt(A, ChainGroups{{0, 1}});
  EXPECT_FALSE(ldlt.factorize(A));
}

// Every second node goes first: with δ on the diagonal of one of these, what is left of its neighbours is of the order
// 1/δ, and nothing of their own is seen beside that. From the ends, as minimum degree goes, nothing grows.
TEST(ChainLdlt, RefusesAMatrixOfWhichAPartIsSingularAndAnotherOrderServes) {
  for (const Index nodes : {5, 9, 33})
    for (const double delta : {1e-3, 1e-8, -1e-14}) {
      Matrix A = 2.0 * Matrix::Identity(nodes, nodes);
      A.diagonal(1).setConstant(-0.9);
      A.diagonal(-1).setConstant(-0.9);
      const ChainGroups groups = chain_groups(lower_triangle(A), 0, ChainLdlt::widest).value();
      A(groups[1][0], groups[1][0]) = delta;
      const SparseMatrix lower = lower_triangle(A);
      ChainLdlt alone(lower, groups);
      EXPECT_EQ(alone.factorize(lower), delta == 1e-3);
      EXPECT_EQ(alone.refused(), delta != 1e-3);
      Ldlt ldlt;
      ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
      EXPECT_EQ(ldlt.inertia()->negative, negative(A));
      Matrix x = A * Vector::LinSpaced(nodes, 1.0, 2.0);
      ldlt.solve(x);
      EXPECT_LE((x - Vector::LinSpaced(nodes, 1.0, 2.0)).cwiseAbs().maxCoeff(), 1e-12) << delta;
    }
}

// A beam of length 1 and stiffness EI = 1, its nodes with the unknowns x, z and θ; cubic elements are exact at their
// nodes. It is held in z at all supports, places in eighths of its length, and in x at the first.
struct Beam {
  Index elements;
  std::vector<Index> supports;
  SparseMatrix lower{};
  std::vector<bool> translation_free{};

  Beam(Index of_elements, std::vector<Index> of_supports)
      : elements(of_elements), supports(std::move(of_supports)), unknown_(static_cast<std::size_t>(3 * elements + 3)) {
    Index next = 0;
    for (Index freedom = 0; freedom < 3 * elements + 3; ++freedom)
      unknown_[static_cast<std::size_t>(freedom)] = is_held(freedom) ? -1 : next++;
    assemble(next);
    translation_free.resize(static_cast<std::size_t>(next));
    for (Index node = 0; node <= elements; ++node) {
      const auto is_support = [&](Index at) { return is_held(3 * at) || is_held(3 * at + 1); };
      if (!is_support(node) && !is_support(std::max(node - 1, Index{0})) && !is_support(std::min(node + 1, elements)))
        translation_free[static_cast<std::size_t>(unknown(3 * node))] = true;
    }
  }

  Index unknown(Index freedom) const { return unknown_[static_cast<std::size_t>(freedom)]; }
  Index deflection(Index eighths) const { return unknown(3 * (elements * eighths / 8) + 1); }

 private:
  bool is_held(Index freedom) const {
    const auto first_of = [&](Index at) { return 3 * (elements * at / 8); };
    return freedom == first_of(supports.front()) ||
           std::any_of(supports.begin(), supports.end(), [&](Index at) { return freedom == first_of(at) + 1; });
  }

  void assemble(Index unknowns) {
    const double h = 1.0 / double(elements), EA = 12.0;
    Matrix block = Matrix::Zero(6, 6);  // of one element
    for (const Index a : {0, 1})
      for (const Index b : {0, 1}) {
        const double sign = a == b ? 1.0 : -1.0, side = a == 0 ? 1.0 : -1.0;
        block(3 * a, 3 * b) = sign * EA / h;
        block(3 * a + 1, 3 * b + 1) = sign * 12.0 / (h * h * h);
        block(3 * a + 1, 3 * b + 2) = block(3 * b + 2, 3 * a + 1) = side * 6.0 / (h * h);
        block(3 * a + 2, 3 * b + 2) = (a == b ? 4.0 : 2.0) / h;
      }
    std::vector<Eigen::Triplet<double, Index>> entries;
    for (Index e = 0; e < elements; ++e)
      for (Index i = 0; i < 6; ++i)
        for (Index j = 0; j <= i; ++j)
          if (unknown(3 * e + i) >= 0 && unknown(3 * e + j) >= 0)
            entries.emplace_back(unknown(3 * e + i), unknown(3 * e + j), block(i, j));
    lower.resize(unknowns, unknowns);
    lower.setFromTriplets(entries.begin(), entries.end());
  }

  std::vector<Index> unknown_;
};

// On two supports under a force of 1 in its middle, which goes down by 1/48. Entries are n⁴ times as great as what they
// leave to resist the whole, 10¹⁸ here.
TEST(ChainLdlt, KnowsThatNothingHoldsWhatIsAfloatHoweverFineTheMesh) {
  const Beam beam(30000, {0, 8});
  const SparseMatrix& lower = beam.lower;
  const Index middle = beam.deflection(4);
  const Vector bending = Vector::Unit(lower.cols(), middle);

  ChainLdlt ldlt(lower, chain_groups(lower, 0, 3).value(), beam.translation_free);
  ASSERT_TRUE(ldlt.factorize(lower));
  EXPECT_EQ(ldlt.pivots().signs.negative, 0);
  Matrix w = bending;
  ldlt.solve(w);
  EXPECT_NEAR(w(middle, 0), 1.0 / 48.0, 1e-6 / 48.0);
  // Nothing but round-off of what bends stands beside the energy of the deflected beam, which is that of the force.
  EXPECT_LE(std::numeric_limits<double>::epsilon() * ldlt.weighted(w), 1e-4 * w(middle, 0));

  ChainLdlt held(lower, chain_groups(lower, 0, 3).value());
  w = bending;
  if (held.factorize(lower)) held.solve(w);
  EXPECT_GT(std::abs(48.0 * w(middle, 0) - 1.0), 0.1);
}

// Wherever the supports are: parts between them are translation_free, and what lies beside a support is not. By eight
// elements.
TEST(ChainLdlt, KnowsBetweenSupportsToo) {
  for (const std::vector<Index>& supports : std::vector<std::vector<Index>>{{0, 3, 8}, {2, 4, 6}, {0, 1, 7}, {5, 8}}) {
    const Beam coarse(8, supports), fine(30000, supports);
    const Index from = supports[0] == 0 ? 2 : 0;
    const Matrix dense = Matrix(coarse.lower).selfadjointView<Eigen::Lower>();
    const Vector expected = dense.ldlt().solve(Vector::Unit(dense.cols(), coarse.deflection(from)));
    ChainLdlt ldlt(fine.lower, chain_groups(fine.lower, 0, 3).value(), fine.translation_free);
    ASSERT_TRUE(ldlt.factorize(fine.lower));
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

// Of a chain so long that its numbers are brought to their places part by part.
TEST(ChainLdlt, SolvesAlongAsAfterwards) {
  Numbers numbers(15);
  for (const Index nodes : {3, 130, 203}) {
    const Matrix A = chain(nodes, 2, numbers);
    const SparseMatrix lower = lower_triangle(A);
    const Matrix expected = numbers.matrix(A.cols(), 3), B = A * expected;
    for (const Index columns : {1, 2, 3}) {
      std::vector<ScaledColumn> of;
      for (Index c = 0; c < columns; ++c) of.push_back({B.col(c).data(), c == 0 ? 1.0 : -2.0});
      ChainLdlt ldlt(lower, chain_groups(lower, 0, ChainLdlt::widest).value());
      Matrix X(A.cols(), columns), Y = B.leftCols(columns);
      ASSERT_TRUE(ldlt.factorize_and_solve(lower, of, X));
      ldlt.solve(Y);
      const double growth = ldlt.pivots().greatest / ldlt.pivots().least;
      for (Index c = 0; c < columns; ++c) {
        EXPECT_EQ(X.col(c), of[static_cast<std::size_t>(c)].factor * Y.col(c));
        EXPECT_LE((Y.col(c) - expected.col(c)).norm(), 1e-13 * growth * double(A.cols()));
      }
    }
  }
}

// One whose numbers no cache holds: memory is asked for what comes later.
TEST(ChainLdlt, SolvesAlongALongChainAsAfterwards) {
  const Beam beam(60000, {0, 8});
  const SparseMatrix& lower = beam.lower;
  const Index middle = beam.deflection(4);
  const Vector bending = Vector::Unit(lower.cols(), middle), pulling = Vector::Unit(lower.cols(), lower.cols() - 2);
  const std::array<ScaledColumn, 2> of{ScaledColumn{bending.data(), 1.0}, ScaledColumn{pulling.data(), -2.0}};
  ChainLdlt ldlt(lower, chain_groups(lower, 0, 3).value(), beam.translation_free);
  Matrix X(lower.cols(), 2), Y(lower.cols(), 2);
  Y << bending, pulling;
  ASSERT_TRUE(ldlt.factorize_and_solve(lower, of, X));
  ldlt.solve(Y);
  EXPECT_EQ(X.col(0), Y.col(0));
  EXPECT_EQ(X.col(1), -2.0 * Y.col(1));
  EXPECT_NEAR(48.0 * Y(middle, 0), 1.0, 1e-5);
  EXPECT_NEAR(12.0 * Y(lower.cols() - 2, 1), 1.0, 1e-5);  // EA = 12
}

TEST(ChainLdlt, NothingIsLeftOfASingularMatrix) {
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
    ChainLdlt ldlt(lower, chain_groups(lower, 0, 3).value());
    EXPECT_FALSE(ldlt.factorize(singular));
    ASSERT_TRUE(ldlt.factorize(lower));
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
    const Index nodes = 20, freedoms = 3, n = nodes * freedoms;
    Matrix A = Matrix::Zero(n + contacts, n + contacts);
    A.topLeftCorner(n, n) = chain(nodes, freedoms, numbers) + 20.0 * Matrix::Identity(n, n);
    for (Index j = 0; j < contacts; ++j) {
      const Vector gradient = numbers.vector(freedoms);
      A.block(n + j, freedoms * (j * nodes / contacts), 1, freedoms) = -gradient.transpose();
      A.block(freedoms * (j * nodes / contacts), n + j, freedoms, 1) = -gradient;
    }
    const SparseMatrix lower = lower_triangle(A);
    Ldlt ldlt;
    ldlt.set_multiplier_count(contacts);
    ASSERT_EQ(ldlt.factorize(lower), FactorStatus::ok);
    EXPECT_EQ(ldlt.inertia()->negative, contacts);
    const Matrix expected = numbers.matrix(A.cols(), 3);
    Matrix X = A * expected;
    ldlt.solve(X);
    EXPECT_LE((X - expected).norm(), 1e-10 * expected.norm());
  }
}

}  // namespace arcwall::chain_ldlt_test
