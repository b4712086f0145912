#include "core/algebra/solvers/lu.hpp"

#include <Eigen/UmfPackSupport>

namespace arcwall {

std::optional<Matrix> solve_by_lu(const SparseMatrix& A, const Matrix& X) {
  if (!all_finite(A.coeffs())) return std::nullopt;
  const Eigen::UmfPackLU<SparseMatrix> lu(A);
  if (lu.info() != Eigen::Success) return std::nullopt;
  Matrix solution = lu.solve(X);
  if (!solution.allFinite()) return std::nullopt;
  return solution;
}

}  // namespace arcwall
