#include "core/algebra/assembly.hpp"

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

void ShiftedLists::add(std::span<const Index> list) {
  std::vector<std::int32_t> shape{static_cast<std::int32_t>(list.size())};
  for (const Index index : list) shape.push_back(static_cast<std::int32_t>(index));
  const std::int32_t first = made_offsets(shape.begin() + 1, shape.end());
  const auto [at, is_new] = known_.try_emplace(shape, static_cast<std::int32_t>(offsets_.size()));
  if (is_new) offsets_.insert(offsets_.end(), shape.begin(), shape.end());
  lists_.push_back({.first = first, .shape = at->second});
}

void ShiftedLists::complete() {
  known_.clear();
  lists_.shrink_to_fit();
  offsets_.shrink_to_fit();
}

SparseMatrix with_rows_behind(const SparseMatrix& A, const std::vector<RowEntry>& entries, Index count) {
  const Index n = A.cols();
  std::vector<RowEntry> sorted = entries;
  std::sort(sorted.begin(), sorted.end(), [](const RowEntry& a, const RowEntry& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  SparseMatrix out(n + count, n + count);
  out.resizeNonZeros(A.nonZeros() + static_cast<Index>(entries.size()) + count);
  SparseIndex *start = out.outerIndexPtr(), *row = out.innerIndexPtr();
  const auto written = [&] { return static_cast<SparseIndex>(row - out.innerIndexPtr()); };
  auto behind = sorted.begin();
  for (Index column = 0; column < n; ++column) {
    start[column] = written();
    row = std::copy(A.innerIndexPtr() + A.outerIndexPtr()[column], A.innerIndexPtr() + A.outerIndexPtr()[column + 1],
                    row);
    for (; behind != sorted.end() && behind->column == column; ++behind)
      *row++ = static_cast<SparseIndex>(n + behind->row);
  }
  for (Index i = n; i < n + count; ++i) {
    start[i] = written();
    *row++ = static_cast<SparseIndex>(i);
  }
  start[n + count] = written();
  std::fill_n(out.valuePtr(), out.nonZeros(), 0.0);
  return out;
}

// Columns that no row behind has an entry in follow each other in both matrices: they are copied together.
void copy_values(const SparseMatrix& A, SparseMatrix& out) {
  const Index n = A.cols();
  const SparseIndex *start = A.outerIndexPtr(), *start_out = out.outerIndexPtr();
  for (Index column = 0, end = 0; column < n; column = end) {
    const SparseIndex shift = start_out[column] - start[column];
    for (end = column + 1; end < n && start_out[end] - start[end] == shift;) ++end;
    double* const behind =
        std::copy(A.valuePtr() + start[column], A.valuePtr() + start[end], out.valuePtr() + start_out[column]);
    std::fill(behind, out.valuePtr() + start_out[end], 0.0);
  }
  std::fill(out.valuePtr() + start_out[n], out.valuePtr() + out.nonZeros(), 0.0);
}

namespace {

// Calls `visit` for the entries of the lower triangle: the diagonal, then those of the blocks, some of them more than
// once. `unknowns_of(b)`: of block b.
template <class UnknownsOf, class Visit>
void for_each_entry(Index unknowns, std::size_t blocks, const UnknownsOf& unknowns_of, const Visit& visit) {
  for (Index i = 0; i < unknowns; ++i) visit(i, i);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto& block = unknowns_of(b);
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t j = 0; j < block.size(); ++j)
        if (block[j] >= 0 && block[i] > block[j]) visit(block[i], block[j]);
  }
}

// The matrix that has them; values are zero.
template <class UnknownsOf>
SparseMatrix pattern_of(Index unknowns, std::size_t blocks, const UnknownsOf& unknowns_of) {
  std::vector<std::ptrdiff_t> ends(static_cast<std::size_t>(unknowns) + 1, 0);  // of each column's entries
  for_each_entry(unknowns, blocks, unknowns_of,
                 [&](Index, Index column) { ++ends[static_cast<std::size_t>(column) + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<SparseIndex> rows(static_cast<std::size_t>(ends.back()));  // by columns
  for_each_entry(unknowns, blocks, unknowns_of, [&](Index row, Index column) {
    rows[static_cast<std::size_t>(ends[static_cast<std::size_t>(column)]++)] = static_cast<SparseIndex>(row);
  });
  SparseMatrix pattern(unknowns, unknowns);
  auto begin = rows.begin(), behind = begin;
  for (Index column = 0; column < unknowns; ++column) {
    const auto end = rows.begin() + ends[static_cast<std::size_t>(column)];
    std::sort(begin, end);
    pattern.outerIndexPtr()[column] = static_cast<SparseIndex>(behind - rows.begin());
    behind = std::copy(begin, std::unique(begin, end), behind);
    begin = end;
  }
  const std::ptrdiff_t count = behind - rows.begin();
  assert(count <= std::numeric_limits<SparseIndex>::max());
  pattern.outerIndexPtr()[unknowns] = static_cast<SparseIndex>(count);
  pattern.resizeNonZeros(count);
  std::copy(rows.begin(), behind, pattern.innerIndexPtr());
  std::fill_n(pattern.valuePtr(), count, 0.0);
  return pattern;
}

}  // namespace

SparseMatrix BlockAssembly::pattern() const {
  return pattern_of(unknown_count_, blocks_.size(), [&](std::size_t b) { return unknowns(static_cast<Index>(b)); });
}

BlockAssembly::BlockAssembly(Index unknowns, const IndexLists& blocks) : unknown_count_(unknowns) {
  assert(unknowns < std::numeric_limits<std::int32_t>::max());
  const SparseMatrix pattern =
      pattern_of(unknowns, blocks.size(), [&](std::size_t b) -> const std::vector<Index>& { return blocks[b]; });
  const auto slot = [&](Index a, Index b) -> std::int32_t {
    if (a < 0 || b < 0) return -1;
    const SparseIndex* const rows = pattern.innerIndexPtr();
    const SparseIndex* const column = pattern.outerIndexPtr() + std::min(a, b);
    return static_cast<std::int32_t>(std::lower_bound(rows + column[0], rows + column[1], std::max(a, b)) - rows);
  };
  std::map<std::vector<std::int32_t>, std::int32_t> known;  // shapes
  std::vector<std::int32_t> shape;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::vector<Index>& block = blocks[b];
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
