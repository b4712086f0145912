#pragma once

#include <optional>

#include "core/types.hpp"

namespace arcwall {

/// A⁻¹ X for an unsymmetric A, by UMFPACK. Empty where A has entries that are not finite, or is singular to working
/// precision.
std::optional<Matrix> solve_by_lu(const SparseMatrix& A, const Matrix& X);

/// Calls `visit(row, column, value)` for the entries of a symmetric matrix whose lower triangle is stored.
template <class Visit>
void for_each_of_both_triangles(const SparseMatrix& lower_triangle, const Visit& visit) {
  for (Index column = 0; column < lower_triangle.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(lower_triangle, column); entry; ++entry) {
      visit(entry.row(), column, entry.value());
      if (entry.row() != column) visit(column, entry.row(), entry.value());
    }
}

}  // namespace arcwall
