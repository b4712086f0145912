#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

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

  /// The same with factor 1 for a block whose size the compiler knows: without loops.
  template <int n, class Entries>
  void add_entries(Index block, double* values, const Entries& K) const {
    const std::int32_t* slot = slots(block);
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j)
#pragma GCC unroll 8
      for (int i = j; i < n; ++i, ++slot)
        if (*slot >= 0) values[*slot] += K(i + j * n);
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
