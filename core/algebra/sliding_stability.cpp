#include "core/algebra/sliding_stability.hpp"

#include <utility>

#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

std::optional<Index> SlidingResistance::negative() const {
  if (!T.allFinite()) return std::nullopt;
  if (T.cols() == 0) return 0;
  return (symmetric_eigenvalues(T).array() < 0.0).count();
}

namespace {

bool is_energetic(const Linearization& equations, Index k) {
  return !equations.energetic.empty() && equations.energetic[static_cast<std::size_t>(k)];
}

}  // namespace

Matrix reduced_rolling(const BorderedSolver& solver, const Linearization& equations) {
  Matrix D = solver.reduced();
  for (const RollingPlace& rolling : equations.rolling)
    D.col(rolling.coordinate) += rolling.stretch * D.col(rolling.place);
  return D;
}

// T = −(D_ff − D_fh D_hh⁻¹ D_hf) diag(1/w), f free to slide and h held, with D = C_x K⁻¹ B − C_s: singular where ∂F/∂x
// is, since det ∂F/∂x = ± det K det D. The continuum's T is symmetric, a mesh's but for discretisation error. Where the
// energy is stationary in s_k, w = 1.
SlidingResistance sliding_resistance(const BorderedSolver& solver, const Linearization& equations) {
  Vector rates = equations.border_rates;
  SlidingResistance resistance;
  for (Index k = 0; k < rates.size(); ++k)
    if (is_energetic(equations, k)) {
      rates[k] = 1.0;
      resistance.slides.push_back(k);
    }
  std::vector<Index> sliding, held;
  for (Index k = 0; k < rates.size(); ++k) {
    const bool slips = equations.slip_senses.size() > 0 && equations.slip_senses[k] != 0.0;
    if (rates[k] == 0.0 && !slips) held.push_back(k);
    if (rates[k] == 0.0 || is_energetic(equations, k)) continue;
    sliding.push_back(k);
    resistance.released.push_back(equations.holding[static_cast<std::size_t>(k)]);
  }
  sliding.insert(sliding.end(), resistance.slides.begin(), resistance.slides.end());
  if (sliding.empty()) return resistance;
  const Matrix rolled = equations.rolling.empty() ? Matrix() : reduced_rolling(solver, equations);
  const Matrix& D = equations.rolling.empty() ? solver.reduced() : rolled;
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
  const auto let_go = static_cast<Index>(released_.size()), free = static_cast<Index>(resistance.slides.size());
  slides_ = equations.B(Eigen::all, resistance.slides);
  by_energy_.resize(free);
  for (Index i = 0; i < free; ++i) {
    const Index k = resistance.slides[static_cast<std::size_t>(i)];
    by_energy_[i] = equations.C(k, K_.cols() + k);
  }
  if (let_go + free == 0) return;
  moved_ = Matrix::Zero(K_.cols(), let_go + free);
  for (Index k = 0; k < let_go; ++k) moved_(released_[static_cast<std::size_t>(k)], k) = 1.0;
  moved_.rightCols(free) = slides_;
  inner_.solve(moved_);
  resistance_.compute(resistance.T);
}

bool SlidingStabilityOperator::is_finite() const {
  return moved_.cols() == 0 || (moved_.allFinite() && resistance_.matrixLU().allFinite());
}

// K⁻¹ + K⁻¹ R T⁻¹ Rᵀ K⁻¹
void SlidingStabilityOperator::solve(Eigen::Ref<Matrix> X) const {
  inner_.solve(X);
  if (moved_.cols() == 0) return;
  Matrix there(moved_.cols(), X.cols());
  there << Matrix(X(released_, Eigen::all)), slides_.transpose() * X;
  X += moved_ * resistance_.solve(there);
}

// Nothing is left of the moments at y, nor of what slides follow.
Matrix SlidingStabilityOperator::product(const Matrix& X) const {
  Matrix Y = K_.selfadjointView<Eigen::Lower>() * X;
  if (slides_.cols() > 0) Y -= slides_ * by_energy_.cwiseInverse().asDiagonal() * (slides_.transpose() * X);
  for (const Index y : released_) Y.row(y).setZero();
  return Y;
}

}  // namespace arcwall
