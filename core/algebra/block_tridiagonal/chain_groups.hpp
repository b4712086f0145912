#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Groups of unknowns of which each couples with itself, the group before and the group behind alone.
using ChainGroups = std::vector<std::vector<Index>>;

/// The groups of a symmetric matrix, given by its lower triangle, without its last unknowns, the multipliers; empty if
/// one had more than `widest` unknowns. A chain of members has its nodes for groups.
std::optional<ChainGroups> chain_groups(const SparseMatrix& lower_triangle, Index multipliers, Index widest);

/// Lets each multiplier follow the others of the last group that it touches. False if there is then one of more than
/// `widest` unknowns, or groups couple that are not beside each other.
bool insert_multipliers(const SparseMatrix& lower_triangle, Index multipliers, Index widest, ChainGroups& groups);

}  // namespace arcwall
