#pragma once

#include "core/factorization.hpp"

namespace arcwall {

/// Eigenpairs of a symmetric matrix whose eigenvalues lie nearest zero.
struct NearNull {
  Vector values{};   ///< by increasing magnitude
  Matrix vectors{};  ///< orthonormal columns
};

/// `count` eigenpairs (fewer if the matrix is smaller) by inverse subspace iteration with Rayleigh-Ritz projection.
/// The factorization is that of `lower_triangle`; a tiny shift of it will do, where the matrix itself is singular.
NearNull near_null(const Factorization& factorization, const SparseMatrix& lower_triangle, Index count,
                   double relative_tolerance = 1e-10);

}  // namespace arcwall
