#include "core/algebra/sliding_stability.hpp"

#include <Eigen/Eigenvalues>
#include <utility>

namespace arcwall {

std::optional<Index> SlidingResistance::negative() const {
  if (!T.allFinite()) return std::nullopt;
  if (released.empty()) return 0;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(T, Eigen::EigenvaluesOnly);
  return (eigen.eigenvalues().array() < 0.0).count();
}

// T = −(D_ff − D_fh D_hh⁻¹ D_hf) diag(1/w), f free to slide and h held, with D = C_x K⁻¹ B − C_s: singular where ∂F/∂x
// is, since det ∂F/∂x = ± det K det D. The continuum's T is symmetric, a mesh's but for discretisation error.
SlidingResistance sliding_resistance(const BorderedSolver& solver, const Linearization& equations) {
  const Vector& rates = equations.border_rates;
  std::vector<Index> sliding, held;
  for (Index k = 0; k < rates.size(); ++k) (rates[k] != 0.0 ? sliding : held).push_back(k);
  const Matrix& D = solver.reduced();
  SlidingResistance resistance;
  for (const Index k : sliding) resistance.released.push_back(equations.holding[static_cast<std::size_t>(k)]);
  if (sliding.empty()) return resistance;
  Matrix T = D(sliding, sliding);
  if (!held.empty()) {
    const Eigen::PartialPivLU<Matrix> within(D(held, held));
    T -= D(sliding, held) * within.solve(Matrix(D(held, sliding)));
  }
  T = -(T * rates(sliding).cwiseInverse().asDiagonal()).eval();
  resistance.T = 0.5 * (T + T.transpose());
  return resistance;
}

SlidingStabilityOperator::SlidingStabilityOperator(const BorderedSolver& solver, const Linearization& equations,
                                                   SlidingResistance resistance)
    : inner_(solver.inner()), K_(equations.K), released_(std::move(resistance.released)) {
  if (released_.empty()) return;
  moved_ = Matrix::Zero(K_.cols(), static_cast<Index>(released_.size()));
  for (Index k = 0; k < moved_.cols(); ++k) moved_(released_[static_cast<std::size_t>(k)], k) = 1.0;
  inner_.solve(moved_);
  resistance_.compute(resistance.T);
}

bool SlidingStabilityOperator::is_finite() const {
  return released_.empty() || (moved_.allFinite() && resistance_.matrixLU().allFinite());
}

// K⁻¹ + K⁻¹ E T⁻¹ Eᵀ K⁻¹
void SlidingStabilityOperator::solve(Eigen::Ref<Matrix> X) const {
  inner_.solve(X);
  if (!released_.empty()) X += moved_ * resistance_.solve(Matrix(X(released_, Eigen::all)));
}

// Nothing is left of the moments at y.
Matrix SlidingStabilityOperator::product(const Matrix& X) const {
  Matrix Y = K_.selfadjointView<Eigen::Lower>() * X;
  for (const Index y : released_) Y.row(y).setZero();
  return Y;
}

}  // namespace arcwall
