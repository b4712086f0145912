#pragma once

#include <vector>

#include "core/algebra/block_tridiagonal/block_elimination.hpp"

namespace arcwall {

/// The numbers of a block-tridiagonal matrix with blocks of one width, then its L D Lᵀ by cyclic reduction (README.md).
/// The chain of blocks is cut into four parts of one length, which are worked on side by side in lanes; the first
/// blocks of the parts are left, a chain like the first.
struct BlockChain {
  static constexpr int parts = Lanes::count;

  BlockChain() = default;
  /// `knows_translations`: the first two unknowns of a block are displacements, and R stands in place of two columns of
  /// D (BlockLayout).
  BlockChain(Index width, Index blocks, bool knows_translations);

  BlockLayout layout() const { return {width}; }
  Lanes* block(Index i) { return numbers.data() + i * layout().size(); }

  Index width = 0, length = 0;  ///< of blocks in unknowns, of parts in blocks
  bool knows_translations = false;
  std::vector<Lanes> numbers{};  ///< BlockLayout by BlockLayout
  std::vector<double> last{};    ///< likewise, of the chain that is left
};

/// The least width with code of its own that blocks of `greatest` unknowns fit in; 0 if there is none.
Index elimination_width(Index greatest);

/// Whether translations can be known of blocks of a width that elimination_width() gave.
constexpr bool can_know_translations(Index width) { return width >= 2 && width <= 5; }

/// Eliminates all blocks. What there is to fill up blocks and lanes counts among the pivots.
PivotScan<double> eliminate_blocks(BlockChain& chain);

/// Right-hand sides of BlockChain::parts, in place, `columns` (one or two) side by side: entry k of column c of block i
/// stands at (i · width + k) · columns + c. `x` has room for one block behind the last one.
void solve_blocks(const BlockChain& chain, Index columns, Lanes* x);

/// |v|ᵀ |L| |D| |L|ᵀ |v|; v like one right-hand side. `grounded_before[i]`: the number of blocks before block i of the
/// chain that resist translations: where none between two blocks does, their part sees v without the translation of the
/// block eliminated, as only the rest of v meets round-off there. Empty where translations are not known.
double weighted_by_blocks(const BlockChain& chain, const std::vector<Index>& grounded_before, Lanes* v);

}  // namespace arcwall
