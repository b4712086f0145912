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

}  // namespace arcwall
