#include "core/pattern_fingerprint.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/assembly.hpp"

namespace arcwall::pattern_fingerprint_test {

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

}  // namespace arcwall::pattern_fingerprint_test
