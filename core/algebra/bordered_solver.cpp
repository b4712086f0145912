#include "core/algebra/bordered_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/algebra/bordered_residual.hpp"

namespace arcwall {

namespace {

// Relative size of the pivots below which a solution may not be trusted unseen.
constexpr double suspicious_pivot = 1e-13;
// By what pivots may be greater than entries, and by what what cancels may be greater than the solution.
constexpr double suspicious_growth = 1e3, suspicious_cancellation = 1e3;
constexpr int max_refinements = 3;
// Part of F that a Newton correction may leave where round-off leaves no better one: the next correction takes it.
constexpr double left_to_newton = 0.1;

LineProducts products_of(const Vector& weights, const Matrix& X) {
  const auto w = weights.array();
  const auto p = X.col(0).array(), t = X.col(1).array();
  return {.pp = (w * p * p).sum(), .pt = (w * p * t).sum(), .tt = (w * t * t).sum()};
}

}  // namespace

Matrix product(const Linearization& equations, const Matrix& X) {
  const Index n = equations.K.cols(), m = equations.B.cols();
  Matrix Y(n + m, X.cols());
  Y.topRows(n).noalias() = equations.K.selfadjointView<Eigen::Lower>() * X.topRows(n);
  if (m > 0) {
    Y.topRows(n).noalias() += equations.B * X.bottomRows(m);
    Y.bottomRows(m) = equations.C.lazyProduct(X);
  }
  if (equations.N.nonZeros() > 0) Y.noalias() += equations.N * X;
  return Y;
}

FactorStatus BorderedSolver::factorize(Linearization& equations, Index multipliers) {
  equations_ = &equations;
  multipliers_ = multipliers;
  const SparseMatrix& K = equations.K;
  const bool same = pattern_.is_of(equations);
  const FactorStatus status = inner_->factorize(K, {.multipliers = multipliers,
                                                    .translation_free = &equations.translation_free,
                                                    .ground = equations.ground,
                                                    .same_pattern = same});
  regular_ = status == FactorStatus::ok && eliminate_border();
  if (regular_ && equations.N.nonZeros() > 0) regular_ = unsymmetric_.factorize(equations.K, equations.N, same);
  return status;
}

// K⁻¹ B and the small matrix that is left for the border's unknowns.
bool BorderedSolver::eliminate_border() {
  const Linearization& now = *equations_;
  const Index m = now.B.cols();
  if (m == 0) return true;
  border_ = now.B;
  inner_->solve(border_);
  reduced_ = now.C.leftCols(now.K.cols()).lazyProduct(border_) - now.C.rightCols(m);
  slides_.compute(reduced_);
  return border_.allFinite() && slides_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0;
}

bool BorderedSolver::solve_inner(Matrix& X) const {
  double cancelled = 0.0;
  return solve_inner(X, cancelled);
}

// With C = [C_x  C_s]:  y = K⁻¹ f,  (C_x K⁻¹ B − C_s) δs = C_x y − g,  δx = y − K⁻¹ B δs. `cancelled`: by what y is
// greater than δx, multipliers aside.
bool BorderedSolver::solve_inner(Matrix& X, double& cancelled) const {
  const Linearization& now = *equations_;
  const Index n = now.K.cols(), m = now.B.cols();
  cancelled = 1.0;
  if (now.N.nonZeros() > 0) {
    unsymmetric_.solve(X);
    return all_finite(X);
  }
  if (m == 0) {
    inner_->solve(X);
    return all_finite(X);
  }
  inner_->solve(X.topRows(n));
  const Matrix s = slides_.solve(now.C.leftCols(n).lazyProduct(X.topRows(n)) - X.bottomRows(m));
  X.bottomRows(m) = s;
  for (Index column = 0; column < X.cols(); ++column) {
    auto x = X.col(column).head(n);  // first y
    const auto size = [&] { return x.head(n - multipliers_).cwiseAbs().maxCoeff(); };
    const double of_y = size();
    x.noalias() -= border_.lazyProduct(s.col(column));
    cancelled = std::max(cancelled, of_y / size());
  }
  return all_finite(X);
}

// Where K is nearly singular but J is not, y and K⁻¹ B are large multiples of one vector, and what they differ in is
// small beside them. Pivots of a fine mesh are far apart anyway: the whole is soft beside an element. Of an unsymmetric
// part no pivots are known.
bool BorderedSolver::is_suspicious(double cancelled) const {
  return !(cancelled < suspicious_cancellation) || equations_->N.nonZeros() > 0 ||
         (inner_->pivot_ratio() < suspicious_pivot && !(inner_->growth(equations_->K) < suspicious_growth));
}

// Where J is nearly singular, J⁻¹ F and J⁻¹ F_λ are large multiples of one vector, and the digits that they differ in
// are lost. What is not finite shows in the products, without weight, too.
bool BorderedSolver::cancellation_is_small(const Row& border, const Matrix& X, const LineProducts& found) const {
  if (!std::isfinite(found.pp) || !std::isfinite(found.tt)) return false;
  if (inner_->pivot_ratio() >= suspicious_pivot) return true;
  const auto p = X.col(0), t = X.col(1);
  const double bp = border.dx.dot(p), bt = border.dx.dot(t), pp = p.squaredNorm(), pt = p.dot(t), tt = t.squaredNorm();
  const double off = bp / (bt + border.dlambda), left = pp - off * (2.0 * pt - off * tt);
  return pp < suspicious_cancellation * suspicious_cancellation * left;
}

// J⁻¹ [−F  −F_λ]; false where J is singular.
bool BorderedSolver::solve_line(EquilibriumLine& line, double& cancelled) {
  line.dlambda = {0.0, 1.0};
  line.off = 0.0;
  line.scale = 1.0;
  cancelled = 1.0;
  const Linearization& now = *equations_;
  line.dx.resize(now.F.size(), 2);
  line.dx.col(0) = -now.F;
  line.dx.col(1) = -now.F_lambda;
  return regular_ && solve_inner(line.dx, cancelled);
}

std::optional<LineProducts> BorderedSolver::line(const Row& border, const Vector& weights, EquilibriumLine& out) {
  const Linearization& now = *equations_;
  Matrix& X = out.dx;
  double cancelled = 0.0;
  if (solve_line(out, cancelled)) {
    const LineProducts found = products_of(weights, X);
    if (!is_suspicious(cancelled) && cancellation_is_small(border, X, found)) return found;
    if (make_line_good(border, out)) return products_of(weights, X);
  }
  factorize_whole(border, X);
  const auto particular = whole_.solve(-now.F, 0.0), tangent = whole_.solve(Vector::Zero(now.F.size()), 1.0);
  if (!particular || !tangent) return std::nullopt;
  X << particular->dx, tangent->dx;
  out.dlambda = {particular->dlambda, tangent->dlambda};
  return products_of(weights, X);
}

// The particular solution becomes the one that the border asks for, which is no larger than need be. What either lacks
// is added; of corrections of the first again what the border asks for, so that one which is good already stays. False
// where that does not help.
bool BorderedSolver::make_line_good(const Row& border, EquilibriumLine& line) {
  const Linearization& now = *equations_;
  auto particular = line.dx.col(0), tangent = line.dx.col(1);
  if (!make_tangent_good(tangent)) return false;
  const double along = border.dx.dot(tangent) + border.dlambda;
  double before = infinity;
  for (int round = 0;; ++round) {
    const double off = border.dx.dot(particular) + border.dlambda * line.dlambda[0];
    particular -= off / along * tangent;
    line.dlambda[0] -= off / along;
    const BorderedResidual residual(now, -1.0, now.F, particular, line.dlambda[0]);
    if (!std::isfinite(residual.size())) return false;
    if (residual.is_small()) return true;
    if (residual.size() > 0.1 * before && residual.size() <= left_to_newton * now.F.norm()) return true;
    if (round == max_refinements) return false;
    before = residual.size();
    Matrix correction = residual.r();
    if (!solve_inner(correction)) return false;
    particular += correction;
  }
}

bool BorderedSolver::tangent(const Row& border, Direction& out, Matrix& columns) {
  const Linearization& now = *equations_;
  columns.col(0) = -now.F_lambda;
  double cancelled = 0.0;
  if (regular_ && solve_inner(columns, cancelled) && (!is_suspicious(cancelled) || make_tangent_good(columns.col(0)))) {
    out.dx = columns.col(0);
    out.dlambda = 1.0;
    return true;
  }
  factorize_whole(border, columns);
  columns.resize(now.F.size(), 1);
  auto solution = whole_.solve(Vector::Zero(now.F.size()), 1.0);
  if (solution) out = std::move(*solution);
  return solution.has_value();
}

bool BorderedSolver::make_tangent_good(Eigen::Ref<Vector> tangent) const {
  const Linearization& now = *equations_;
  for (int round = 0;; ++round) {
    const BorderedResidual residual(now, -1.0, now.F_lambda, tangent, 0.0);
    if (!std::isfinite(residual.size())) return false;
    if (residual.is_small()) return true;
    if (round == max_refinements) return false;
    Matrix correction = residual.r();
    if (!solve_inner(correction)) return false;
    tangent += correction;
  }
}

std::optional<Direction> BorderedSolver::solve(const Row& border, const Vector& f, double g) {
  const Linearization& now = *equations_;
  Matrix X;
  if (regular_) {
    X.resize(f.size(), 2);
    X << f, now.F_lambda;
    const bool solved = solve_inner(X);
    // δλ = (g − cᵀ J⁻¹ f) / (d − cᵀ J⁻¹ F_λ),  δx = J⁻¹ f − δλ J⁻¹ F_λ
    const double dlambda = (g - border.dx.dot(X.col(0))) / (border.dlambda - border.dx.dot(X.col(1)));
    Direction solution{.dx = X.col(0) - dlambda * X.col(1), .dlambda = dlambda};
    if (solved && solution.dx.allFinite() && BorderedResidual(now, 1.0, f, solution.dx, dlambda).is_small())
      return solution;
  }
  factorize_whole(border, X);
  return whole_.solve(f, g);
}

// K's own solutions, where there are any (the last for F_λ or for what is tracked), are mostly what K hardly resists.
void BorderedSolver::factorize_whole(const Row& border, const Matrix& columns) {
  const bool solved = regular_ && columns.cols() > 0 && columns.rows() == border.dx.size() && columns.allFinite();
  whole_.factorize(*equations_, border, multipliers_, solved ? Vector(columns.rightCols(1)) : border.dx);
}

}  // namespace arcwall
