#include "core/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <numeric>

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

SparseMatrix BlockAssembly::pattern() const {
  SparseMatrix pattern(unknown_count(), unknown_count());
  pattern.resizeNonZeros(static_cast<Index>(rows_.size()));
  std::copy(columns_.begin(), columns_.end(), pattern.outerIndexPtr());
  std::copy(rows_.begin(), rows_.end(), pattern.innerIndexPtr());
  std::fill_n(pattern.valuePtr(), pattern.nonZeros(), 0.0);
  return pattern;
}

BlockAssembly::BlockAssembly(Index unknowns, const std::vector<std::vector<Index>>& blocks) {
  assert(unknowns < std::numeric_limits<std::int32_t>::max());
  const auto for_each_entry = [&](const auto& visit) {
    for (Index i = 0; i < unknowns; ++i) visit(static_cast<std::size_t>(i), static_cast<std::int32_t>(i));
    for (const std::vector<Index>& block : blocks)
      for (const Index column : block)
        for (const Index row : block)
          if (column >= 0 && row > column) visit(static_cast<std::size_t>(column), static_cast<std::int32_t>(row));
  };
  std::vector<std::ptrdiff_t> ends(static_cast<std::size_t>(unknowns) + 1, 0);  // of each column's entries
  for_each_entry([&](std::size_t column, std::int32_t) { ++ends[column + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::int32_t> sorted(static_cast<std::size_t>(ends.back()));  // by columns
  for_each_entry([&](std::size_t column, std::int32_t row) { sorted[static_cast<std::size_t>(ends[column]++)] = row; });
  columns_.assign(1, 0);
  auto begin = sorted.begin();
  for (std::size_t column = 0; column + 1 < ends.size(); ++column) {
    const auto end = sorted.begin() + ends[column];
    std::sort(begin, end);
    rows_.insert(rows_.end(), begin, std::unique(begin, end));
    columns_.push_back(static_cast<std::int32_t>(rows_.size()));
    begin = end;
  }
  rows_.shrink_to_fit();
  assert(rows_.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()));

  const auto slot = [&](Index a, Index b) -> std::int32_t {
    if (a < 0 || b < 0) return -1;
    const auto column = static_cast<std::size_t>(std::min(a, b));
    const auto first = rows_.begin() + columns_[column], last = rows_.begin() + columns_[column + 1];
    return static_cast<std::int32_t>(std::lower_bound(first, last, std::max(a, b)) - rows_.begin());
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
