#include "core/algebra/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

namespace arcwall {

namespace {

template <class Solver>
Vector values_of(const Solver& eigen) {
  const Vector& values = eigen.eigenvalues();
  if (eigen.info() == Eigen::Success) return values;
  return Vector::Constant(values.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Vector symmetric_eigenvalues(const Matrix& A) {
  return values_of(Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly));
}

SymmetricEigen symmetric_eigenpairs(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(A);
  return {.values = values_of(eigen), .vectors = eigen.eigenvectors()};
}

SymmetricEigen symmetric_eigenpairs(const Matrix& A, const Matrix& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(A, M);
  return {.values = values_of(eigen), .vectors = eigen.eigenvectors()};
}

}  // namespace arcwall
