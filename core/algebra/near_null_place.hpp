#pragma once

#include "core/types.hpp"

namespace arcwall {

/// The unknown in which a vector that a matrix hardly resists has most of its energy: where a spring holds it best.
/// `diagonal`: the matrix's.
inline Index near_null_place(const Vector& diagonal, const Vector& soft) {
  Index place = 0;
  soft.cwiseAbs2().cwiseProduct(diagonal.cwiseAbs()).maxCoeff(&place);
  return place;
}

}  // namespace arcwall
