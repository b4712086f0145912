#include "core/algebra/fingerprint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/algebra/assembly.hpp"

namespace arcwall::fingerprint_test {

namespace {

SparseMatrix of(Index unknowns, const IndexLists& blocks) { return BlockAssembly(unknowns, blocks).pattern(); }

}  // namespace

TEST(PatternFingerprint, IsThatOfThePatternAlone) {
  SparseMatrix A = of(4, {{0, 1}, {1, 2}, {2, 3}});
  const PatternFingerprint before(A);
  A.coeffs().setConstant(infinity);
  EXPECT_EQ(PatternFingerprint(A), before);
  EXPECT_EQ(PatternFingerprint(SparseMatrix(A)), before);
  EXPECT_TRUE(before.has_sizes_of(A));
}

// Also where the numbers of columns and entries are the same, and where the entries of each column are as many.
TEST(PatternFingerprint, TellsPatternsApart) {
  const std::vector<SparseMatrix> others{of(4, {{0, 1}, {1, 2}, {2, 3}}),
                                         of(4, {{0, 2}, {1, 2}, {2, 3}}),
                                         of(4, {{0, 1}, {1, 3}, {2, 3}}),
                                         of(4, {{0, 3}, {1, 2}, {2, 3}}),
                                         of(4, {{0, 1}, {2, 3}}),
                                         of(5, {{0, 1}, {1, 2}, {2, 3}}),
                                         of(4, {}),
                                         of(0, {})};
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t j = 0; j < others.size(); ++j)
      EXPECT_EQ(PatternFingerprint(others[i]) == PatternFingerprint(others[j]), i == j) << i << " and " << j;
  for (const SparseMatrix& A : others) EXPECT_FALSE(PatternFingerprint() == PatternFingerprint(A));
}

TEST(StateFingerprint, TellsStatesApartToTheLastBit) {
  const State state{.x = Vector{{1.0, 2.0, 3.0}}, .lambda = 0.5, .piece = {0, 1}};
  EXPECT_EQ(StateFingerprint(state), StateFingerprint(State(state)));
  const auto differs = [&](const auto& change) {
    State other = state;
    change(other);
    return !(StateFingerprint(other) == StateFingerprint(state));
  };
  EXPECT_TRUE(differs([](State& other) { other.x[2] = std::nextafter(3.0, 4.0); }));
  EXPECT_TRUE(differs([](State& other) { other.x.reverseInPlace(); }));
  EXPECT_TRUE(differs([](State& other) { other.x.conservativeResize(2); }));
  EXPECT_TRUE(differs([](State& other) { other.lambda = std::nextafter(0.5, 1.0); }));
  EXPECT_TRUE(differs([](State& other) { other.piece[0] = 1; }));
  EXPECT_TRUE(differs([](State& other) { other.piece = Piece(2, 0); }));
  EXPECT_FALSE(StateFingerprint() == StateFingerprint(State{}));
}

}  // namespace arcwall::fingerprint_test
