#pragma once

#include <vector>

#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// P A Pᵀ = L D Lᵀ of a dense symmetric matrix, definite or not: pivots of one and of two rows (Bunch and Kaufman 1977,
/// by LAPACK's dsytrf).
class DenseLdlt {
 public:
  /// The lower triangle of a matrix. False if a pivot is zero or not finite.
  bool factorize(Matrix lower_triangle);

  /// X := A⁻¹ X.
  void solve(Eigen::Ref<Matrix> X) const;

  /// The eigenvalues of D.
  const Pivots& pivots() const { return pivots_; }

 private:
  bool read_pivots();

  Matrix factors_;              // L below the diagonal, D on it and beside
  std::vector<int> exchanges_;  // as LAPACK counts them: two rows with one pivot have the same negative number
  Pivots pivots_;
};

}  // namespace arcwall
