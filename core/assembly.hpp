#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// An entry of a row behind a matrix: of row `row` of those and a column of the matrix.
struct RowEntry {
  Index row, column;
};

/// The lower triangle of a matrix with `count` rows and their diagonal behind it; values are zero.
SparseMatrix with_rows_behind(const SparseMatrix& lower_triangle, const std::vector<RowEntry>& entries, Index count);

/// Sums small symmetric blocks into a sparse matrix whose pattern is laid out once: where every entry of every block
/// goes is looked up here, never in a step.
class BlockAssembly {
 public:
  /// `blocks[b]` lists the unknowns of block b in the order of its rows; −1 stands for an unknown that is held.
  BlockAssembly(Index unknowns, const std::vector<std::vector<Index>>& blocks);

  /// Lower triangle with the pattern of all blocks and the whole diagonal; values are zero.
  const SparseMatrix& pattern() const { return pattern_; }

  std::span<const Index> unknowns(Index block) const {
    const auto from = static_cast<std::size_t>(first_unknown_[static_cast<std::size_t>(block)]);
    const auto to = static_cast<std::size_t>(first_unknown_[static_cast<std::size_t>(block) + 1]);
    return std::span(unknowns_).subspan(from, to - from);
  }

  /// Adds factor · lower triangle of the n × n block, whose entries K(i + n·j) are (column-major), into the values of
  /// a matrix that has pattern().
  template <class Entries>
  void add_entries(Index block, double factor, double* values, const Entries& K) const {
    const std::int32_t* slot = slots(block);
    const Index n =
        first_unknown_[static_cast<std::size_t>(block) + 1] - first_unknown_[static_cast<std::size_t>(block)];
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i, ++slot)
        if (*slot >= 0) values[*slot] += factor * K(i + j * n);
  }

  void add(Index block, const double* K, double factor, double* values) const {
    add_entries(block, factor, values, [K](Index entry) { return K[entry]; });
  }

  /// The lower triangles of several n × n blocks, `K(entry, which)`, with factor 1: where no unknown is `held`,
  /// without a question.
  template <int n, std::size_t count, class Entries>
  void add_entries(const std::array<Index, count>& blocks, bool held, double* values, const Entries& K) const {
    if (held) {
      for (std::size_t which = 0; which < count; ++which)
        add_entries(blocks[which], 1.0, values, [&](Index entry) { return K(entry, which); });
      return;
    }
    std::array<const std::int32_t*, count> slot;
    for (std::size_t which = 0; which < count; ++which) slot[which] = slots(blocks[which]);
    int next = 0;
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j)
#pragma GCC unroll 8
      for (int i = j; i < n; ++i, ++next)
        for (std::size_t which = 0; which < count; ++which) values[slot[which][next]] += K(i + j * n, which);
  }

 private:
  const std::int32_t* slots(Index block) const {
    return &slots_[static_cast<std::size_t>(first_slot_[static_cast<std::size_t>(block)])];
  }

  SparseMatrix pattern_;
  std::vector<Index> unknowns_, first_unknown_, first_slot_;
  std::vector<std::int32_t> slots_;  // position in the values, −1 where a row or column is held
};

}  // namespace arcwall
