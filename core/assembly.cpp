#include "core/assembly.hpp"

#include <algorithm>
#include <cassert>

namespace arcwall {

SparseMatrix with_rows_behind(const SparseMatrix& A, const std::vector<RowEntry>& entries, Index count) {
  const Index n = A.cols();
  std::vector<RowEntry> sorted = entries;
  std::sort(sorted.begin(), sorted.end(), [](const RowEntry& a, const RowEntry& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  SparseMatrix out(n + count, n + count);
  out.resizeNonZeros(A.nonZeros() + static_cast<Index>(entries.size()) + count);
  Index *start = out.outerIndexPtr(), *row = out.innerIndexPtr();
  auto behind = sorted.begin();
  for (Index column = 0; column < n; ++column) {
    start[column] = row - out.innerIndexPtr();
    row = std::copy(A.innerIndexPtr() + A.outerIndexPtr()[column], A.innerIndexPtr() + A.outerIndexPtr()[column + 1],
                    row);
    for (; behind != sorted.end() && behind->column == column; ++behind) *row++ = n + behind->row;
  }
  for (Index i = n; i < n + count; ++i) {
    start[i] = row - out.innerIndexPtr();
    *row++ = i;
  }
  start[n + count] = row - out.innerIndexPtr();
  std::fill_n(out.valuePtr(), out.nonZeros(), 0.0);
  return out;
}

BlockAssembly::BlockAssembly(Index unknowns, const std::vector<std::vector<Index>>& blocks)
    : pattern_(unknowns, unknowns) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < unknowns; ++i) entries.emplace_back(i, i, 0.0);
  for (const std::vector<Index>& block : blocks)
    for (const Index column : block)
      for (const Index row : block)
        if (column >= 0 && row > column) entries.emplace_back(row, column, 0.0);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();
  assert(pattern_.nonZeros() <= std::numeric_limits<std::int32_t>::max());

  const auto slot = [&](Index a, Index b) -> std::int32_t {
    if (a < 0 || b < 0) return -1;
    const Index column = std::min(a, b), row = std::max(a, b);
    const Index* first = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column];
    const Index* last = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
    return static_cast<std::int32_t>(std::lower_bound(first, last, row) - pattern_.innerIndexPtr());
  };
  for (const std::vector<Index>& block : blocks) {
    first_unknown_.push_back(static_cast<Index>(unknowns_.size()));
    first_slot_.push_back(static_cast<Index>(slots_.size()));
    unknowns_.insert(unknowns_.end(), block.begin(), block.end());
    for (std::size_t j = 0; j < block.size(); ++j)
      for (std::size_t i = j; i < block.size(); ++i) slots_.push_back(slot(block[i], block[j]));
  }
  first_unknown_.push_back(static_cast<Index>(unknowns_.size()));
}

}  // namespace arcwall
