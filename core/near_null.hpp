#pragma once

#include "core/factorization.hpp"

namespace arcwall {

/// Eigenpairs K φ = μ M φ of a symmetric matrix whose eigenvalues lie nearest zero; M diagonal, zero for multipliers.
struct NearNull {
  Vector values{};   ///< by increasing magnitude
  Matrix vectors{};  ///< columns, φᵀ M φ = 1
};

/// `count` eigenpairs (fewer if M has fewer entries above zero) by inverse subspace iteration with Rayleigh-Ritz
/// projection. The factorization is that of `lower_triangle`; a tiny shift of it will do, where the matrix itself is
/// singular. With multipliers of weight zero these are the eigenvalues of K on the space the constraints leave free.
NearNull near_null(const Factorization& factorization, const SparseMatrix& lower_triangle, const Vector& weights,
                   Index count, double relative_tolerance = 1e-10);

}  // namespace arcwall
