#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Groups of unknowns of which each couples with itself, the group before and the group behind alone.
using ChainGroups = std::vector<std::vector<Index>>;

/// The groups of a symmetric matrix, given by its lower triangle, whose last `multipliers` unknowns follow the others
/// of their group; empty if one had more than `widest` unknowns. A chain of members has its nodes for groups.
std::optional<ChainGroups> chain_groups(const SparseMatrix& lower_triangle, Index multipliers, Index widest);

}  // namespace arcwall
