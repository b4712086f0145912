#include "core/sprung_border.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace arcwall {

// S = −(K⁻¹)_yy is what the body resists a motion at y by.
SprungBorder::SprungBorder(const Factorization& inner, const SparseMatrix& lower_triangle,
                           const std::vector<Index>& holding, const Vector& springs)
    : inner_(inner), K_(lower_triangle) {
  std::vector<Index> finite;
  for (Index k = 0; k < springs.size(); ++k)
    if (std::isfinite(springs[k])) finite.push_back(k);
  for (const Index k : finite) released_.push_back(holding[static_cast<std::size_t>(k)]);
  const auto count = static_cast<Index>(released_.size());
  moved_ = Matrix::Zero(K_.cols(), count);
  for (Index k = 0; k < count; ++k) moved_(released_[static_cast<std::size_t>(k)], k) = 1.0;
  if (count > 0) inner_.solve(moved_);
  resistance_ = -moved_(released_, Eigen::all);
  resistance_.diagonal() += springs(finite);
}

bool SprungBorder::is_finite() const { return moved_.allFinite() && resistance_.allFinite(); }

// n₋ = n₋(K) + n₋(S + diag c) but for the multipliers among the y (Haynsworth 1968).
Index SprungBorder::negative() const {
  if (released_.empty()) return 0;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(resistance_, Eigen::EigenvaluesOnly);
  return (eigen.eigenvalues().array() < 0.0).count();
}

// (K − E (diag c)⁻¹ Eᵀ)⁻¹ = K⁻¹ + K⁻¹ E (S + diag c)⁻¹ Eᵀ K⁻¹, which needs no c above zero.
void SprungBorder::solve(Eigen::Ref<Matrix> X) const {
  inner_.solve(X);
  if (!released_.empty()) X += moved_ * resistance_.partialPivLu().solve(Matrix(X(released_, Eigen::all)));
}

// The moments at y are those of the springs, so that nothing is left there.
Matrix SprungBorder::product(const Matrix& X) const {
  Matrix Y = K_.selfadjointView<Eigen::Lower>() * X;
  for (const Index y : released_) Y.row(y).setZero();
  return Y;
}

}  // namespace arcwall
