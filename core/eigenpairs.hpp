#pragma once

#include <memory>
#include <utility>

#include "core/types.hpp"

namespace arcwall {

/// A matrix that nobody changes any more: its copies are the same one.
class SharedMatrix {
 public:
  SharedMatrix() = default;
  SharedMatrix(Matrix matrix) : matrix_(std::make_shared<const Matrix>(std::move(matrix))) {}

  const Matrix& operator*() const {
    static const Matrix nothing;
    return matrix_ ? *matrix_ : nothing;
  }
  const Matrix* operator->() const { return &**this; }

 private:
  std::shared_ptr<const Matrix> matrix_;
};

/// Eigenpairs K φ = μ M φ of a symmetric matrix whose eigenvalues lie nearest zero; M diagonal, zero for multipliers.
struct NearNull {
  Vector values{};         ///< by increasing magnitude
  SharedMatrix vectors{};  ///< columns, φᵀ M φ = 1

  /// The vectors that K may not resist a step further: the nearest one, and those of negative values.
  Matrix least_resisted() const;
};

}  // namespace arcwall
