#include "core/algebra/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

namespace arcwall {

bool is_positive_definite(const Matrix& M) {
  return Eigen::LLT<Matrix>(0.5 * (M + M.transpose())).info() == Eigen::Success;
}

// The last column of the orthogonal factor of Aᵀ.
Vector null_vector(const Matrix& A) {
  return Eigen::HouseholderQR<Matrix>(A.transpose()).householderQ() * Vector::Unit(A.cols(), A.rows());
}

}  // namespace arcwall
