#include "continuation/corners/outgoing_directions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace arcwall {

namespace {

// The rate problem in the degenerate contacts' guards: ġ + c ṗ = λ̇ a + M ṗ, c their compliances.
struct RateProblem {
  State open{};        // the corner with all degenerate contacts open
  Vector free_rate{};  // ẋ for λ̇ = 1 without degenerate forces
  Matrix response{};   // ẋ for unit degenerate forces
  Vector a{};
  Matrix M{};
};

// Rates of λ and of the degenerate contacts' forces.
struct Solution {
  double lambda;
  Vector p;
};

std::optional<RateProblem> reduce(const UnilateralSystem& system, const State& corner,
                                  const std::vector<Index>& degenerate, CornerWorkspace& workspace) {
  RateProblem problem;
  Piece piece = corner.piece;
  for (const Index j : degenerate) piece[static_cast<std::size_t>(j)] = 0;
  problem.open = system.with_piece(corner, piece);
  auto& [now, solver] = workspace;
  system.linearize(problem.open, now);
  if (solver.factorize(now, system.multiplier_count(piece)) != FactorStatus::ok) return std::nullopt;
  const auto w = static_cast<Index>(degenerate.size());
  Matrix X(now.F.size(), 1 + w);
  X.col(0) = -now.F_lambda;
  for (Index i = 0; i < w; ++i) X.col(1 + i) = system.unit_force(problem.open, degenerate[static_cast<std::size_t>(i)]);
  if (!solver.solve_inner(X)) return std::nullopt;
  problem.free_rate = X.col(0);
  problem.response = X.rightCols(w);
  problem.a.resize(w);
  problem.M.resize(w, w);
  for (Index i = 0; i < w; ++i) {
    const Row gap = system.guard_gradient(problem.open, degenerate[static_cast<std::size_t>(i)]);
    problem.a[i] = gap.dx.dot(problem.free_rate) + gap.dlambda;
    problem.M.row(i) = gap.dx.transpose() * problem.response;
    problem.M(i, i) += system.compliance(degenerate[static_cast<std::size_t>(i)]);
  }
  if (!problem.a.allFinite() || !problem.M.allFinite()) return std::nullopt;
  return problem;
}

// The direction (λ̇, ṗ_A) with ġ_A + c ṗ_A = 0 and ṗ = 0 outside A: the null vector of [a_A M_AA], up to its length and
// sign.
Solution direction_with(const RateProblem& problem, const std::vector<Index>& active) {
  const auto k = static_cast<Index>(active.size());
  Solution solution{.lambda = 1.0, .p = Vector::Zero(problem.a.size())};
  if (k == 0) return solution;
  Matrix A(k, k + 1);
  for (Index i = 0; i < k; ++i) {
    A(i, 0) = problem.a[active[static_cast<std::size_t>(i)]];
    for (Index j = 0; j < k; ++j)
      A(i, j + 1) = problem.M(active[static_cast<std::size_t>(i)], active[static_cast<std::size_t>(j)]);
  }
  // The last column of the orthogonal factor of Aᵀ spans the null space of A.
  const Vector null = Eigen::HouseholderQR<Matrix>(A.transpose()).householderQ() * Vector::Unit(k + 1, k);
  solution.lambda = null[0];
  for (Index j = 0; j < k; ++j) solution.p[active[static_cast<std::size_t>(j)]] = null[j + 1];
  return solution;
}

// Lemke's method with covering vector d for 0 ≤ p ⊥ q + M p ≥ 0; empty when it ends on a ray or takes too long.
std::optional<Vector> lemke(const Matrix& M, const Vector& q, const Vector& d) {
  const Index n = q.size();
  if ((q.array() >= 0.0).all()) return Vector::Zero(n);
  // Tableau of w − M p − d z0 = q, basis w; columns: w, p, z0, right-hand side.
  Matrix T(n, 2 * n + 2);
  T << Matrix::Identity(n, n), -M, -d, q;
  std::vector<Index> basis(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) basis[static_cast<std::size_t>(i)] = i;
  const auto pivot = [&](Index row, Index column) {
    T.row(row) /= T(row, column);
    for (Index i = 0; i < n; ++i)
      if (i != row) T.row(i) -= T(i, column) * T.row(row);
    const Index left = basis[static_cast<std::size_t>(row)];
    basis[static_cast<std::size_t>(row)] = column;
    return left;
  };
  Index row = 0;
  (q.array() / d.array()).minCoeff(&row);
  Index left = pivot(row, 2 * n);
  for (Index round = 0; round < 50 * (n + 1); ++round) {
    const Index entering = left < n ? left + n : left - n;  // the complement of what left the basis
    row = -1;
    for (Index i = 0; i < n; ++i)
      if (T(i, entering) > 1e-12 &&
          (row < 0 || T(i, 2 * n + 1) * T(row, entering) < T(row, 2 * n + 1) * T(i, entering) ||
           (basis[static_cast<std::size_t>(i)] == 2 * n &&
            T(i, 2 * n + 1) * T(row, entering) <= T(row, 2 * n + 1) * T(i, entering))))
        row = i;
    if (row < 0) return std::nullopt;
    left = pivot(row, entering);
    if (left != 2 * n) continue;
    Vector p = Vector::Zero(n);
    for (Index i = 0; i < n; ++i)
      if (basis[static_cast<std::size_t>(i)] >= n) p[basis[static_cast<std::size_t>(i)] - n] = T(i, 2 * n + 1);
    return p;
  }
  return std::nullopt;
}

// All complementary directions of a small problem, one a subset of closed contacts.
std::vector<Solution> enumerate(const RateProblem& problem) {
  std::vector<Solution> found;
  const auto w = static_cast<unsigned>(problem.a.size());
  for (unsigned subset = 0; subset < (1U << w); ++subset) {
    std::vector<Index> active;
    for (unsigned j = 0; j < w; ++j)
      if (subset >> j & 1U) active.push_back(static_cast<Index>(j));
    const Solution forward = direction_with(problem, active);
    found.push_back(forward);
    found.push_back({.lambda = -forward.lambda, .p = -forward.p});
  }
  return found;
}

// Candidates for a large problem: with positive definite M each sign of λ̇ has one solution and any covering vector
// finds it; else several are tried.
std::vector<Solution> pivoted(const RateProblem& problem) {
  std::vector<Solution> found;
  const Index w = problem.a.size();
  const double scale = problem.M.cwiseAbs().maxCoeff();
  const Matrix M = problem.M / scale;
  std::vector<Vector> covers{Vector::Ones(w)};
  if (Eigen::LLT<Matrix>(M).info() != Eigen::Success)
    for (Index j = 0; j < w; ++j) {
      covers.push_back(Vector::Ones(w));
      covers.back()[j] = 8.0;
    }
  for (const double sign : {1.0, -1.0})
    for (const Vector& cover : covers)
      if (const auto p = lemke(M, sign * problem.a, cover)) found.push_back({.lambda = sign, .p = *p / scale});
  return found;
}

// The direction of a solution in the unknowns of its own piece; none if a rate has the wrong sign.
std::vector<OutgoingDirection> direction_of(const UnilateralSystem& system, const State& corner,
                                            const std::vector<Index>& degenerate, const RateProblem& problem,
                                            const Solution& solution, const CornerOptions& options) {
  Direction motion{.dx = solution.lambda * problem.free_rate + problem.response * solution.p,
                   .dlambda = solution.lambda};
  Vector gap_rate = solution.lambda * problem.a + problem.M * solution.p;
  const double length = std::hypot(motion.dx.norm() / std::max(problem.free_rate.norm(), 1e-300), motion.dlambda);
  if (!(length > 0.0)) return {};
  const Vector p = solution.p / length;
  gap_rate /= length;
  motion.dx /= length;
  motion.dlambda /= length;
  const double g_zero = options.rate_tolerance * std::max(problem.a.cwiseAbs().maxCoeff(), 1e-300);
  const double p_zero = options.rate_tolerance * std::max(p.cwiseAbs().maxCoeff(), 1e-300);
  if ((p.array() < -p_zero).any() || (gap_rate.array() < -g_zero).any()) return {};

  OutgoingDirection way;
  way.piece = corner.piece;
  way.loading = Piece(corner.piece.size(), 0);
  for (Index i = 0; i < p.size(); ++i) {
    const auto j = static_cast<std::size_t>(degenerate[static_cast<std::size_t>(i)]);
    if (p[i] > p_zero) way.piece[j] = way.loading[j] = 1;
    if (p[i] <= p_zero && gap_rate[i] > g_zero) way.piece[j] = 0;
  }
  way.direction.dlambda = motion.dlambda;
  way.direction.dx = system.transfer(motion.dx, problem.open.piece, way.piece);
  for (Index i = 0; i < p.size(); ++i)
    if (const auto k = system.multiplier_index(way.piece, degenerate[static_cast<std::size_t>(i)]))
      way.direction.dx[*k] = p[i] * system.multiplier_scale();
  return {std::move(way)};
}

// Whether two directions move the structure, whose unknowns are the first n, alike; contact forces follow from that.
bool same(const UnilateralSystem& system, Index n, const OutgoingDirection& a, const OutgoingDirection& b,
          double tolerance) {
  const Vector weights = system.weights(a.piece);
  const auto x = [n](const OutgoingDirection& way) { return way.direction.dx.head(n).array(); };
  const auto w = weights.head(n).array();
  const double aa = (w * x(a).square()).sum(), bb = (w * x(b).square()).sum(), ab = (w * x(a) * x(b)).sum();
  const double lambda = a.direction.dlambda * b.direction.dlambda;
  return lambda >= 0.0 && ab >= (1.0 - tolerance) * std::sqrt(aa * bb) && std::abs(aa - bb) <= 1e-4 * (aa + bb);
}

}  // namespace

std::vector<OutgoingDirection> outgoing_directions(const UnilateralSystem& system, const State& corner,
                                                   const std::vector<Index>& degenerate, const CornerOptions& options,
                                                   CornerWorkspace& workspace) {
  const auto problem = reduce(system, corner, degenerate, workspace);
  if (!problem) return {};
  const bool small = static_cast<int>(degenerate.size()) <= options.max_enumerated;
  const Index n = workspace.equations.K.cols() - system.multiplier_count(problem->open.piece);
  std::vector<OutgoingDirection> found;
  for (const Solution& solution : small ? enumerate(*problem) : pivoted(*problem))
    for (OutgoingDirection& way : direction_of(system, corner, degenerate, *problem, solution, options)) {
      const auto known = [&](const OutgoingDirection& other) {
        return same(system, n, way, other, options.same_direction);
      };
      if (std::none_of(found.begin(), found.end(), known)) found.push_back(std::move(way));
    }
  return found;
}

}  // namespace arcwall
