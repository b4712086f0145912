#pragma once

#include <cmath>

#include "core/types.hpp"

namespace arcwall {

/// vᵀ K v, summed with twice the digits, and by how much it changes at most when each entry of K does in its last
/// digit.
struct QuadraticForm {
  double value = 0.0;
  double roundoff = 0.0;  ///< ε |v|ᵀ |K| |v|

  bool is_zero() const { return std::abs(value) <= roundoff; }  ///< within round-off
};

QuadraticForm quadratic_form(const SparseMatrix& lower_triangle, const Eigen::Ref<const Vector>& v);

}  // namespace arcwall
