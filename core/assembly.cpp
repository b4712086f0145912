#include "core/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

namespace arcwall {

namespace {

// From the least number, which is returned, on; negative ones stay. 0 if there are no others.
template <class Iterator>
std::int32_t made_offsets(Iterator begin, Iterator end) {
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  std::int32_t least = none;
  for (auto i = begin; i != end; ++i)
    if (*i >= 0) least = std::min(least, *i);
  if (least == none) return 0;
  for (auto i = begin; i != end; ++i)
    if (*i >= 0) *i -= least;
  return least;
}

}  // namespace

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
  std::map<std::vector<std::int32_t>, std::int32_t> known;  // shapes
  std::vector<std::int32_t> shape;
  for (const std::vector<Index>& block : blocks) {
    shape.clear();
    for (const Index unknown : block) shape.push_back(static_cast<std::int32_t>(unknown));
    const std::int32_t first_unknown = made_offsets(shape.begin(), shape.end());
    const auto rows = static_cast<std::ptrdiff_t>(block.size());
    for (std::size_t j = 0; j < block.size(); ++j)
      for (std::size_t i = j; i < block.size(); ++i) shape.push_back(slot(block[i], block[j]));
    const std::int32_t first_slot = made_offsets(shape.begin() + rows, shape.end());
    const auto [at, is_new] = known.try_emplace(shape, static_cast<std::int32_t>(shapes_.size()));
    if (is_new) shapes_.insert(shapes_.end(), shape.begin(), shape.end());
    blocks_.push_back({.first_unknown = first_unknown,
                       .first_slot = first_slot,
                       .shape = at->second,
                       .rows = static_cast<std::int32_t>(rows)});
  }
}

}  // namespace arcwall
