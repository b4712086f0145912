#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <map>
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

/// The values of that lower triangle into a matrix with rows behind it; zero in these.
void copy_values(const SparseMatrix& lower_triangle, SparseMatrix& with_rows);

using IndexLists = std::vector<std::vector<Index>>;

/// Indices that differ from those of other lists by a shift: of the unknowns of a block in the order of its rows, −1
/// for one that is held, for example.
class ShiftedIndices {
 public:
  ShiftedIndices(Index first, std::span<const std::int32_t> offsets) : first_(first), offsets_(offsets) {}

  std::size_t size() const { return offsets_.size(); }
  Index operator[](std::size_t i) const { return offsets_[i] < 0 ? -1 : first_ + offsets_[i]; }

  /// Where an index stands; size() if it does not.
  std::size_t place_of(Index index) const {
    std::size_t i = 0;
    while (i < size() && (*this)[i] != index) ++i;
    return i;
  }

  /// Index i is first() + offsets()[i] where none is −1.
  Index first() const { return first_; }
  const std::int32_t* offsets() const { return offsets_.data(); }

  template <class Test>
  bool any(const Test& test) const {
    for (std::size_t i = 0; i < size(); ++i)
      if (test((*this)[i])) return true;
    return false;
  }
  bool any_held() const {
    return any([](Index unknown) { return unknown < 0; });
  }

 private:
  Index first_;
  std::span<const std::int32_t> offsets_;
};

/// Lists of indices, of which those that differ by a shift share their offsets: the first index and where these stand
/// are kept of each.
class ShiftedLists {
 public:
  /// The next list, of indices ≥ 0; −1 stands for none.
  void add(std::span<const Index> list);

  /// No list follows.
  void complete();

  ShiftedIndices operator[](Index i) const {
    const List& list = lists_[static_cast<std::size_t>(i)];
    const auto size = static_cast<std::size_t>(offsets_[static_cast<std::size_t>(list.shape)]);
    return {list.first, std::span(offsets_).subspan(static_cast<std::size_t>(list.shape) + 1, size)};
  }

 private:
  struct List {
    std::int32_t first, shape;  // where the size and then the offsets stand
  };

  std::vector<List> lists_;
  std::vector<std::int32_t> offsets_;
  std::map<std::vector<std::int32_t>, std::int32_t> known_;  // shapes
};

/// Sums small symmetric blocks into a sparse matrix whose pattern is laid out once: where every entry of every block
/// goes is looked up here, never in a step. Blocks that differ by a shift of their unknowns and of their places alone,
/// as those of a member do, share what is looked up.
class BlockAssembly {
 public:
  /// `blocks[b]` lists the unknowns of block b in the order of its rows; −1 stands for an unknown that is held.
  BlockAssembly(Index unknowns, const IndexLists& blocks);

  Index unknown_count() const { return unknown_count_; }

  /// Lower triangle with the pattern of all blocks and the whole diagonal; values are zero. Made anew each time.
  SparseMatrix pattern() const;

  ShiftedIndices unknowns(Index block) const {
    const Block& at = blocks_[static_cast<std::size_t>(block)];
    return {at.first_unknown, std::span(shapes_).subspan(static_cast<std::size_t>(at.shape), at.size())};
  }

  /// Adds factor · lower triangle of the n × n block, whose entries K(i + n·j) are (column-major), into the values of
  /// a matrix that has pattern().
  template <class Entries>
  void add_entries(Index block, double factor, double* values, const Entries& K) const {
    const Block& at = blocks_[static_cast<std::size_t>(block)];
    const std::int32_t* slot = slots(at);
    values += at.first_slot;
    for (Index j = 0; j < at.rows; ++j)
      for (Index i = j; i < at.rows; ++i, ++slot)
        if (*slot >= 0) values[*slot] += factor * K(i + j * at.rows);
  }

  /// `K` must have the n² entries of the block, or more.
  void add(Index block, std::span<const double> K, double factor, double* values) const {
    assert(K.size() >= unknowns(block).size() * unknowns(block).size());
    add_entries(block, factor, values, [K](Index entry) { return K[static_cast<std::size_t>(entry)]; });
  }

  /// The lower triangles of several n × n blocks, `K(entry, which)`, with factor 1: without a question where they are
  /// `shifted`, see are_shifted().
  template <int n, class Number, std::size_t count, class Entries>
  void add_entries(const std::array<Number, count>& blocks, bool shifted, double* values, const Entries& K) const {
    if (!shifted) {
      for (std::size_t which = 0; which < count; ++which)
        add_entries(blocks[which], 1.0, values, [&](Index entry) { return K(entry, which); });
      return;
    }
    const std::int32_t* slot = slots(blocks_[static_cast<std::size_t>(blocks[0])]);
    std::array<double*, count> first;
    for (std::size_t which = 0; which < count; ++which)
      first[which] = values + blocks_[static_cast<std::size_t>(blocks[which])].first_slot;
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j)
#pragma GCC unroll 8
      for (int i = j; i < n; ++i, ++slot)
        for (std::size_t which = 0; which < count; ++which) first[which][*slot] += K(i + j * n, which);
  }

  /// Whether no unknown of these is held, and they differ by a shift alone.
  template <class Number, std::size_t count>
  bool are_shifted(const std::array<Number, count>& blocks) const {
    const std::int32_t shape = blocks_[static_cast<std::size_t>(blocks[0])].shape;
    const auto alike = [&](Number block) { return blocks_[static_cast<std::size_t>(block)].shape == shape; };
    return std::all_of(blocks.begin(), blocks.end(), alike) && !unknowns(blocks[0]).any_held();
  }

 private:
  // Its offsets from the first unknown begin at `shape`, behind them stand those of its entries' positions in the
  // values from the first one; −1 where a row or column is held.
  struct Block {
    std::int32_t first_unknown, first_slot, shape, rows;

    std::size_t size() const { return static_cast<std::size_t>(rows); }
  };

  const std::int32_t* slots(const Block& block) const {
    return &shapes_[static_cast<std::size_t>(block.shape + block.rows)];
  }

  Index unknown_count_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> shapes_;
};

}  // namespace arcwall
