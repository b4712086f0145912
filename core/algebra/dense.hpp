#pragma once

#include "core/types.hpp"

namespace arcwall {

// Factorizations of small dense matrices for all rooms: each unit that makes one of Eigen's compiles 5 to 10 s longer.

/// Whether the symmetric part of a square matrix is positive definite.
bool is_positive_definite(const Matrix& M);

/// Returns a vector x of unit length with A x = 0. A: one more column than rows.
Vector null_vector(const Matrix& A);

}  // namespace arcwall
