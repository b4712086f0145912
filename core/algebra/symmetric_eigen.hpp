#pragma once

#include "core/types.hpp"

namespace arcwall {

/// Eigenvalues of a small dense symmetric matrix, ascending, and their vectors as columns. Values are NaN where the
/// iteration does not converge, as with entries that are not finite. Of a matrix only the lower triangle is read.
struct SymmetricEigen {
  Vector values{};
  Matrix vectors{};
};

/// Returns the eigenvalues alone.
Vector symmetric_eigenvalues(const Matrix& A);

/// Returns the pairs A v = μ v, |v| = 1.
SymmetricEigen symmetric_eigenpairs(const Matrix& A);

/// Returns the pairs A v = μ M v, vᵀ M v = 1. M: positive definite.
SymmetricEigen symmetric_eigenpairs(const Matrix& A, const Matrix& M);

}  // namespace arcwall
