#pragma once

#include <Eigen/SparseLU>
#include <memory>

#include "core/types.hpp"

namespace arcwall {

/// LU of K + N, K symmetric and N with entries where K has some.
class UnsymmetricFactors {
 public:
  /// K by its lower triangle. `same_pattern`: as that of the last K. False where the sum is singular to working
  /// precision.
  bool factorize(const SparseMatrix& K, const SparseMatrix& N, bool same_pattern);

  /// X := (K + N)⁻¹ X
  void solve(Matrix& X) const { X = lu_->solve(X).eval(); }

 private:
  using Lu = Eigen::SparseLU<SparseMatrix, Eigen::COLAMDOrdering<SparseIndex>>;
  std::unique_ptr<Lu> lu_;  // of a pattern
};

}  // namespace arcwall
