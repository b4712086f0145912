#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Which contacts are closed: per guard 0 (open) or 1 (closed). The equations are smooth on one piece.
using Piece = std::vector<std::uint8_t>;

/// All that varies along a path.
struct State {
  Vector x{};           ///< unknowns; their number depends on the piece
  double lambda = 0.0;  ///< the path parameter
  Piece piece{};        ///< empty for a system without guards
};

/// A covector of (x, λ): the derivative of one scalar function of the state.
struct Row {
  Vector dx{};
  double dlambda = 0.0;
};

/// A vector of (x, λ): a tangent, or the difference of two states on one piece.
struct Direction {
  Vector dx{};
  double dlambda = 0.0;
};

/// The row applied to the direction.
inline double apply(const Row& row, const Direction& direction) {
  return row.dx.dot(direction.dx) + row.dlambda * direction.dlambda;
}

/// from + s · direction, on the piece of `from`.
inline State moved(const State& from, const Direction& direction, double s) {
  return {.x = from.x + s * direction.dx, .lambda = from.lambda + s * direction.dlambda, .piece = from.piece};
}

/// to − from; both on one piece.
inline Direction difference(const State& to, const State& from) {
  return {.dx = to.x - from.x, .dlambda = to.lambda - from.lambda};
}

}  // namespace arcwall
