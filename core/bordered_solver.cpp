#include "core/bordered_solver.hpp"

#include <cmath>

namespace arcwall {

namespace {

// Relative size of the pivots below which a solution is not trusted unseen.
constexpr double suspicious_pivot = 1e-13;
constexpr double good_residual = 1e-10;
constexpr int max_refinements = 3;

// Improves X so that K X = B; false if it cannot be made good.
bool refine(const SparseMatrix& K, const Ldlt& ldlt, const Matrix& B, Eigen::Ref<Matrix> X) {
  for (int round = 0; round <= max_refinements; ++round) {
    Matrix R = B;
    R.noalias() -= K.selfadjointView<Eigen::Lower>() * X;
    if (!R.allFinite()) return false;
    if (R.norm() <= good_residual * B.norm()) return true;
    ldlt.solve(R);
    X += R;
  }
  return false;
}

}  // namespace

FactorStatus BorderedSolver::factorize(const Linearization& equations, Index multipliers) {
  equations_ = &equations;
  ldlt_.set_multiplier_count(multipliers);
  const FactorStatus status = ldlt_.factorize(equations.K);
  regular_ = status == FactorStatus::ok;
  return status;
}

bool BorderedSolver::line(const Row& border, EquilibriumLine& out) {
  const Linearization& now = *equations_;
  columns_.resize(now.F.size(), 2);
  columns_.col(0) = -now.F;
  columns_.col(1) = -now.F_lambda;
  if (solve_inner(columns_, 2)) {
    out.particular = {.dx = columns_.col(0), .dlambda = 0.0};
    out.tangent = {.dx = columns_.col(1), .dlambda = 1.0};
    return true;
  }
  if (!factorize_whole(border)) return false;
  out.particular = solve_whole(-now.F, 0.0);
  out.tangent = solve_whole(Vector::Zero(now.F.size()), 1.0);
  return out.particular.dx.allFinite() && out.tangent.dx.allFinite();
}

bool BorderedSolver::tangent(const Row& border, Direction& out, Matrix& others) {
  const Linearization& now = *equations_;
  columns_.resize(now.F.size(), 1 + others.cols());
  columns_.col(0) = -now.F_lambda;
  columns_.rightCols(others.cols()) = others;
  if (solve_inner(columns_, 1)) {
    out = {.dx = columns_.col(0), .dlambda = 1.0};
    others = columns_.rightCols(others.cols());
    return true;
  }
  others.resize(now.F.size(), 0);
  if (!factorize_whole(border)) return false;
  out = solve_whole(Vector::Zero(now.F.size()), 1.0);
  return out.dx.allFinite();
}

// X := K⁻¹ X; false if K is singular, or so nearly that the first `checked` columns cannot be made good.
bool BorderedSolver::solve_inner(Matrix& X, Index checked) const {
  if (!regular_) return false;
  const bool suspicious = ldlt_.pivot_ratio() < suspicious_pivot;
  const Matrix B = suspicious ? X.leftCols(checked) : Matrix();
  ldlt_.solve(X);
  return X.allFinite() && (!suspicious || refine(equations_->K, ldlt_, B, X.leftCols(checked)));
}

std::optional<Direction> BorderedSolver::solve(const Row& border, const Vector& f, double g) {
  const Linearization& now = *equations_;
  if (regular_) {
    Matrix X(f.size(), 2);
    X << f, now.F_lambda;
    ldlt_.solve(X);
    // δλ = (g − cᵀ K⁻¹ f) / (d − cᵀ K⁻¹ F_λ),  δx = K⁻¹ f − δλ K⁻¹ F_λ
    const double dlambda = (g - border.dx.dot(X.col(0))) / (border.dlambda - border.dx.dot(X.col(1)));
    Direction solution{.dx = X.col(0) - dlambda * X.col(1), .dlambda = dlambda};
    Vector r = f - now.F_lambda * dlambda;
    r.noalias() -= now.K.selfadjointView<Eigen::Lower>() * solution.dx;
    const double scale = f.norm() + std::abs(dlambda) * now.F_lambda.norm();
    if (solution.dx.allFinite() && r.norm() <= good_residual * scale) return solution;
  }
  if (!factorize_whole(border)) return std::nullopt;
  Direction solution = solve_whole(f, g);
  if (!solution.dx.allFinite() || !std::isfinite(solution.dlambda)) return std::nullopt;
  return solution;
}

bool BorderedSolver::factorize_whole(const Row& border) {
  const Linearization& now = *equations_;
  const Index n = now.K.cols();
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(static_cast<std::size_t>(2 * now.K.nonZeros() + 2 * n + 1));
  for (Index column = 0; column < n; ++column)
    for (SparseMatrix::InnerIterator entry(now.K, column); entry; ++entry) {
      entries.emplace_back(entry.row(), column, entry.value());
      if (entry.row() != column) entries.emplace_back(column, entry.row(), entry.value());
    }
  for (Index i = 0; i < n; ++i) {
    if (now.F_lambda[i] != 0.0) entries.emplace_back(i, n, now.F_lambda[i]);
    if (border.dx[i] != 0.0) entries.emplace_back(n, i, border.dx[i]);
  }
  entries.emplace_back(n, n, border.dlambda);
  SparseMatrix whole(n + 1, n + 1);
  whole.setFromTriplets(entries.begin(), entries.end());
  whole.makeCompressed();
  return lu_.factorize(whole) == FactorStatus::ok;
}

Direction BorderedSolver::solve_whole(const Vector& f, double g) const {
  Matrix X(f.size() + 1, 1);
  X.col(0).head(f.size()) = f;
  X(f.size(), 0) = g;
  lu_.solve(X);
  return {.dx = X.col(0).head(f.size()), .dlambda = X(f.size(), 0)};
}

}  // namespace arcwall
