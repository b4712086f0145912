#include "core/algebra/singular_bordered_solver.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "core/algebra/bordered_residual.hpp"
#include "core/algebra/near_null.hpp"
#include "core/algebra/solvers/lu.hpp"

namespace arcwall {

void SingularBorderedSolver::factorize(Linearization& equations, const Row& border, Index multipliers,
                                       const Vector& soft) {
  equations_ = &equations;
  border_ = border;
  has_spring_ = equations.N.nonZeros() == 0 && add_spring(multipliers, soft);
}

std::optional<Direction> SingularBorderedSolver::solve(const Vector& f, double g) {
  if (has_spring_) {
    if (auto solution = refined_with_spring(f, g)) return solution;
    has_spring_ = false;
  }
  return solve_with_lu(f, g);
}

// As stiff as what it is added to, in the unknown that takes most of the energy.
bool SingularBorderedSolver::add_spring(Index multipliers, const Vector& soft) {
  SparseMatrix& K = equations_->K;
  const Index n = K.cols(), free = n - multipliers;
  if (free == 0) return false;
  const Vector diagonal = K.diagonal();
  at_ = near_null_place(diagonal.head(free), soft.head(free));
  spring_ = std::abs(diagonal[at_]);
  if (!(spring_ > 0.0 && std::isfinite(spring_))) return false;
  std::vector<GroundTerm> ground = equations_->ground;
  ground.push_back({.row = at_, .column = at_, .stiffness = spring_});
  const double without = std::exchange(K.coeffRef(at_, at_), diagonal[at_] + spring_);
  const FactorStatus status = sprung_->factorize(
      K, {.multipliers = multipliers, .translation_free = &equations_->translation_free, .ground = ground});
  K.coeffRef(at_, at_) = without;
  if (status != FactorStatus::ok) return false;
  const Index m = equations_->B.cols(), lambda = m, force = m + 1;
  responses_.setZero(n, m + 2);
  if (m > 0) responses_.leftCols(m) = equations_->B;
  responses_.col(lambda) = equations_->F_lambda.head(n);
  responses_(at_, force) = -1.0;
  sprung_->solve(responses_);
  if (!responses_.allFinite()) return false;
  // (1) of s, λ and p, its last equation over −k; without a border B and C have no size at all
  Matrix small = rows_of(responses_);
  small *= -1.0;
  if (m > 0) small.topLeftCorner(m, m) += equations_->C.rightCols(m);
  small.col(lambda).head(m) += equations_->F_lambda.tail(m);
  small.row(lambda).head(m) += border_.dx.tail(m).transpose();
  small(lambda, lambda) += border_.dlambda;
  small(force, force) -= 1.0 / spring_;
  small_.compute(small);  // what is singular shows in the residuals
  return true;
}

// What the rows of the small system are of x: C_x x, c_xᵀ x, eᵀ x.
Matrix SingularBorderedSolver::rows_of(const Matrix& x) const {
  const Index n = x.rows(), m = equations_->B.cols();
  Matrix rows(m + 2, x.cols());
  if (m > 0) rows.topRows(m) = equations_->C.leftCols(n) * x;
  rows.row(m) = border_.dx.head(n).transpose() * x;
  rows.row(m + 1) = x.row(at_);
  return rows;
}

Direction SingularBorderedSolver::solve_with_spring(const Vector& f, double g) const {
  const Index n = equations_->K.cols(), m = equations_->B.cols();
  Matrix x = f.head(n);
  sprung_->solve(x);
  Vector right = -rows_of(x);
  right.head(m) += f.tail(m);
  right[m] += g;
  const Vector of = small_.solve(right);
  Direction solution{.dx = Vector(n + m), .dlambda = of[m]};
  solution.dx.head(n) = x - responses_ * of;
  solution.dx.tail(m) = of.head(m);
  return solution;
}

std::optional<Direction> SingularBorderedSolver::refined_with_spring(const Vector& f, double g) const {
  constexpr int most_refinements = 3;
  Direction solution = solve_with_spring(f, g);
  for (int round = 0;; ++round) {
    const BorderedResidual left(*equations_, 1.0, f, solution.dx, solution.dlambda);
    const double gap = g - apply(border_, solution);
    const double terms =
        std::abs(g) + border_.dx.cwiseAbs().dot(solution.dx.cwiseAbs()) + std::abs(border_.dlambda * solution.dlambda);
    if (!std::isfinite(left.size()) || !std::isfinite(gap)) return std::nullopt;
    if (left.is_small() && std::abs(gap) <= BorderedResidual::rounding * terms) return solution;
    if (round == most_refinements) return std::nullopt;
    const Direction correction = solve_with_spring(left.r(), gap);
    solution.dx += correction.dx;
    solution.dlambda += correction.dlambda;
  }
}

// J and F_λ, and below them a row that holds one of the unknowns.
SparseMatrix SingularBorderedSolver::with_one_held(Index held) const {
  const Linearization& now = *equations_;
  const Index n = now.K.cols(), m = now.B.cols(), last = n + m;
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(static_cast<std::size_t>(2 * now.K.nonZeros() + 2 * (1 + m) * n + 1));
  const auto add = [&](Index row, Index column, double value) {
    if (value != 0.0) entries.emplace_back(row, column, value);
  };
  for_each_of_both_triangles(now.K, add);
  for (Index k = 0; k < now.N.outerSize(); ++k)
    for (SparseMatrix::InnerIterator entry(now.N, k); entry; ++entry) add(entry.row(), entry.col(), entry.value());
  for (Index k = 0; k < m; ++k) {
    for (Index i = 0; i < n; ++i) add(i, n + k, now.B(i, k));
    for (Index i = 0; i < last; ++i) add(n + k, i, now.C(k, i));
  }
  for (Index i = 0; i < last; ++i) add(i, last, now.F_lambda[i]);
  add(last, held, 1.0);
  SparseMatrix whole(last + 1, last + 1);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

// The border is a full row, with which LU takes a time and a memory like the square of the number of unknowns: in its
// place the unknown is held in which it is greatest. The solution lies on the line that is left where that is let go.
std::optional<Direction> SingularBorderedSolver::solve_with_lu(const Vector& f, double g) const {
  const Index last = f.size();
  Index held = 0;
  if (border_.dx.cwiseAbs().maxCoeff(&held) < std::abs(border_.dlambda)) held = last;
  Matrix right = Matrix::Zero(last + 1, 2);
  right.col(0).head(last) = f;
  right(last, 1) = 1.0;
  const auto X = solve_by_lu(with_one_held(held), right);
  if (!X) return std::nullopt;
  const auto column = [&](Index c) { return Direction{.dx = X->col(c).head(last), .dlambda = (*X)(last, c)}; };
  const Direction particular = column(0), line = column(1);
  const double along = (g - apply(border_, particular)) / apply(border_, line);
  if (!std::isfinite(along)) return std::nullopt;
  return Direction{.dx = particular.dx + along * line.dx, .dlambda = particular.dlambda + along * line.dlambda};
}

}  // namespace arcwall
