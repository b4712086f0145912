#include "core/algebra/block_tridiagonal/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace arcwall {

namespace {

// Of each unknown, itself included, sorted.
class Neighbours {
 public:
  Neighbours(const SparseMatrix& lower_triangle, Index n) : ends_(static_cast<std::size_t>(n) + 1, 0) {
    const auto behind = [this](Index unknown) -> SparseIndex& { return ends_[static_cast<std::size_t>(unknown) + 1]; };
    for_each(lower_triangle, n, [&](Index unknown, Index) { ++behind(unknown); });
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    all_.resize(static_cast<std::size_t>(ends_.back()));
    std::vector<SparseIndex> next(ends_.begin(), ends_.end() - 1);
    // By columns: those before an unknown come before its own column.
    for_each(lower_triangle, n, [&](Index unknown, Index other) {
      all_[static_cast<std::size_t>(next[static_cast<std::size_t>(unknown)]++)] = static_cast<SparseIndex>(other);
    });
  }

  std::size_t size() const { return ends_.size() - 1; }
  std::span<const SparseIndex> of(Index unknown) const {
    const SparseIndex* const ends = &ends_[static_cast<std::size_t>(unknown)];
    return {all_.data() + ends[0], all_.data() + ends[1]};
  }

 private:
  template <class Visit>
  static void for_each(const SparseMatrix& lower_triangle, Index n, const Visit& visit) {
    for (Index column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator entry(lower_triangle, column); entry; ++entry) {
        if (entry.row() >= n) continue;
        visit(column, entry.row());
        if (entry.row() != column) visit(entry.row(), column);
      }
  }

  std::vector<SparseIndex> ends_, all_;
};

// The unknowns with the same neighbours.
std::vector<Index> alike(const Neighbours& neighbours, Index unknown) {
  const auto near = neighbours.of(unknown);
  std::vector<Index> result;
  for (const SparseIndex other : near)
    if (std::ranges::equal(neighbours.of(other), near)) result.push_back(other);
  return result;
}

// What can be reached from some unknowns, by the number of steps that it takes.
class Levels {
 public:
  explicit Levels(const Neighbours& neighbours) : neighbours_(neighbours), seen_(neighbours.size(), 0) {}

  bool seen(Index unknown) const { return seen_[static_cast<std::size_t>(unknown)] == visit_; }

  // Appends the levels of a part; false if one is wider than `widest`.
  bool from(std::vector<Index> level, Index widest, Blocks& out) {
    for (const Index unknown : level) mark(unknown);
    while (!level.empty()) {
      if (static_cast<Index>(level.size()) > widest) return false;
      std::vector<Index> next;
      for (const Index unknown : level)
        for (const Index other : neighbours_.of(unknown))
          if (!seen(other)) {
            mark(other);
            next.push_back(other);
          }
      out.push_back(std::move(level));
      level = std::move(next);
    }
    return true;
  }

  void forget() { ++visit_; }

 private:
  void mark(Index unknown) { seen_[static_cast<std::size_t>(unknown)] = visit_; }

  const Neighbours& neighbours_;
  std::vector<int> seen_;
  int visit_ = 1;
};

// Whether all entries of unknowns that have a block are in blocks or between blocks beside each other.
bool is_tridiagonal(const SparseMatrix& A, const Blocks& blocks) {
  constexpr Index in_no_block = -1;
  std::vector<Index> block(static_cast<std::size_t>(A.cols()), in_no_block);
  for (std::size_t g = 0; g < blocks.size(); ++g)
    for (const Index unknown : blocks[g]) block[static_cast<std::size_t>(unknown)] = static_cast<Index>(g);
  for (Index column = 0; column < A.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
      if (const Index other = block[static_cast<std::size_t>(entry.row())];
          other != in_no_block && std::abs(other - block[static_cast<std::size_t>(column)]) > 1)
        return false;
  return true;
}

}  // namespace

std::optional<Blocks> find_blocks(const SparseMatrix& A, Index multipliers, Index widest) {
  const Index n = A.cols() - multipliers;
  if (n == 0) return std::nullopt;
  const Neighbours near(A, n);
  Levels search(near), levels(near);
  Blocks blocks;
  for (Index unknown = 0; unknown < n; ++unknown) {
    if (levels.seen(unknown)) continue;
    // From the far end of what is found from anywhere.
    Blocks found;
    search.forget();
    if (!search.from(alike(near, unknown), n, found)) return std::nullopt;
    std::vector<Index> start = alike(near, found.back().front());
    if (!levels.from(std::move(start), widest, blocks)) return std::nullopt;
  }
  if (!is_tridiagonal(A, blocks)) return std::nullopt;
  return blocks;
}

Index take_in_couplings(const SparseMatrix& A, Index multipliers, Blocks& blocks) {
  const Index n = A.cols() - multipliers;
  struct Reach {
    std::size_t first, last;
  };
  std::vector<Reach> reach(static_cast<std::size_t>(multipliers), {blocks.size(), 0});
  for (std::size_t block = 0; block < blocks.size(); ++block)
    for (const Index column : blocks[block])
      for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
        if (entry.row() < n) continue;
        Reach& of = reach[static_cast<std::size_t>(entry.row() - n)];
        of = {std::min(of.first, block), std::max(of.last, block)};
      }
  Index taken = 0;
  for (const Reach& of : reach) {
    if (of.last != of.first + 2) break;
    blocks[of.first + 1].push_back(n + taken++);
  }
  return taken;
}

}  // namespace arcwall
