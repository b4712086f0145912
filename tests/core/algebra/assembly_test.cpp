#include "core/algebra/assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/dense.hpp"

namespace arcwall::assembly_test {

namespace {

// Blocks that overlap, whose unknowns are in any order and in part held.
const IndexLists some_blocks{{0, 1, 2}, {4, 2, -1}, {-1, -1}, {3, 0}, {5}};

}  // namespace

TEST(BlockAssembly, SumsBlocksLikeADenseMatrix) {
  const BlockAssembly assembly(6, some_blocks);
  SparseMatrix K = assembly.pattern();
  Matrix expected = Matrix::Zero(6, 6);
  test::Numbers numbers(13);
  for (std::size_t b = 0; b < some_blocks.size(); ++b) {
    const auto n = static_cast<Index>(some_blocks[b].size());
    Matrix block = numbers.matrix(n, n);
    block = (block + block.transpose()).eval();
    const double factor = numbers();
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Index row = some_blocks[b][static_cast<std::size_t>(i)];
        const Index column = some_blocks[b][static_cast<std::size_t>(j)];
        if (row >= 0 && column >= 0) expected(row, column) += factor * block(i, j);
      }
    block.triangularView<Eigen::StrictlyUpper>().setConstant(infinity);  // not read
    assembly.add(static_cast<Index>(b), {block.data(), static_cast<std::size_t>(block.size())}, factor, K.valuePtr());
  }
  EXPECT_LE((test::full(K) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(BlockAssembly, PatternIsTheLowerTriangleOfAllBlocksWithTheWholeDiagonal) {
  const BlockAssembly assembly(7, some_blocks);
  const SparseMatrix& pattern = assembly.pattern();
  EXPECT_TRUE(pattern.isCompressed());
  EXPECT_EQ(pattern.nonZeros(), 7 + 3 + 1 + 1);  // diagonal; 1-0, 2-0, 2-1; 4-2; 3-0
  for (Index column = 0; column < 7; ++column)
    for (SparseMatrix::InnerIterator entry(pattern, column); entry; ++entry) {
      EXPECT_GE(entry.row(), column);
      EXPECT_EQ(entry.value(), 0.0);
    }
}

// A row of blocks whose places differ by a shift, but for the first, which is held in part, and the last, numbered in
// another order.
TEST(BlockAssembly, KnowsBlocksThatDifferByAShift) {
  IndexLists blocks{{-1, 1, 2, 3}};
  for (Index i = 1; i < 5; ++i) blocks.push_back({2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3});
  blocks.push_back({11, 10, 12, 13});
  const BlockAssembly assembly(14, blocks);
  EXPECT_TRUE(assembly.are_shifted(std::array<Index, 4>{1, 2, 3, 4}));
  EXPECT_FALSE(assembly.are_shifted(std::array<Index, 4>{0, 1, 2, 3}));
  EXPECT_FALSE(assembly.are_shifted(std::array<Index, 4>{0, 0, 0, 0}));
  EXPECT_FALSE(assembly.are_shifted(std::array<Index, 4>{2, 3, 4, 5}));
  test::Numbers numbers(14);
  const Matrix entries = numbers.matrix(16, 4);
  const std::array<Index, 4> four{1, 2, 3, 4};
  Matrix together[2];
  for (const bool shifted : {true, false}) {
    SparseMatrix K = assembly.pattern();
    assembly.add_entries<4>(four, shifted, K.valuePtr(),
                            [&](Index entry, std::size_t which) { return entries(entry, static_cast<Index>(which)); });
    together[shifted ? 0 : 1] = test::full(K);
  }
  EXPECT_EQ(together[0], together[1]);
}

// Also where a row has an entry in the first column, in neighbouring columns and in the last.
TEST(RowsBehind, LeaveTheValuesOfTheMatrixBeforeThem) {
  SparseMatrix A = BlockAssembly(6, some_blocks).pattern();
  test::Numbers numbers(15);
  for (Index i = 0; i < A.nonZeros(); ++i) A.valuePtr()[i] = numbers();
  const std::vector<std::vector<RowEntry>> rows{
      {}, {{0, 3}}, {{0, 0}, {1, 5}}, {{1, 2}, {0, 2}, {0, 3}}, {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}};
  for (const std::vector<RowEntry>& entries : rows) {
    SparseMatrix out = with_rows_behind(A, entries, 2);
    std::fill_n(out.valuePtr(), out.nonZeros(), infinity);
    copy_values(A, out);
    Matrix expected = Matrix::Zero(8, 8);
    expected.topLeftCorner(6, 6) = test::full(A);
    EXPECT_EQ(test::full(out), expected) << entries.size();
    EXPECT_EQ(out.nonZeros(), A.nonZeros() + static_cast<Index>(entries.size()) + 2);
  }
}

TEST(BlockAssembly, GivesBackTheUnknownsOfEachBlock) {
  const BlockAssembly assembly(6, some_blocks);
  for (std::size_t b = 0; b < some_blocks.size(); ++b) {
    const auto unknowns = assembly.unknowns(static_cast<Index>(b));
    ASSERT_EQ(unknowns.size(), some_blocks[b].size());
    for (std::size_t i = 0; i < unknowns.size(); ++i) EXPECT_EQ(unknowns[i], some_blocks[b][i]);
  }
}

}  // namespace arcwall::assembly_test
