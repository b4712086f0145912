#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Blocks of unknowns of a block-tridiagonal matrix: each couples with itself and with the blocks before and behind
/// alone.
using Blocks = std::vector<std::vector<Index>>;

/// The blocks of a symmetric matrix, given by its lower triangle, without its last unknowns, the multipliers; empty if
/// one had more than `widest` unknowns. A chain of members has its nodes for blocks.
std::optional<Blocks> find_blocks(const SparseMatrix& lower_triangle, Index multipliers, Index widest);

/// Puts the first multipliers, as far as each has entries in three blocks one behind the other, last into the middle
/// one. Returns how many: they couple that block with its neighbours, as its other unknowns do.
Index take_in_couplings(const SparseMatrix& lower_triangle, Index multipliers, Blocks& blocks);

}  // namespace arcwall
