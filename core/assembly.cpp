#include "core/assembly.hpp"

#include <algorithm>
#include <cassert>

namespace arcwall {

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
