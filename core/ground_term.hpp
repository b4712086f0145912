#pragma once

#include <span>

#include "core/types.hpp"

namespace arcwall {

/// A part of an entry of a stiffness matrix K that joins a node to the ground instead of to other nodes: of a spring,
/// or of a contact that gives way. K contains it; it is listed besides because K's diagonal loses it where short
/// elements are 10¹⁶ times as stiff, and a solver that knows it does not (core/algebra/block_tridiagonal/README.md).
struct GroundTerm {
  Index row, column;  ///< unknowns of one node, row ≥ column; K is symmetric
  double stiffness;   ///< part of K(row, column)
};

using GroundTerms = std::span<const GroundTerm>;

}  // namespace arcwall
