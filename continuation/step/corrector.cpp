#include "continuation/step/corrector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "continuation/stability.hpp"
#include "core/algebra/sliding_stability.hpp"
#include "core/algebra/test_function.hpp"

namespace arcwall {

// Newton on the closed system. The states that satisfy the linearised equilibrium are a line,
//
//   K δx + F_λ δλ = −F:   (δx, δλ) = particular + τ · tangent                                           (1)
//
// and the constraint picks the point on it: a linear equation for planes and values, a quadratic for spheres. This is
// the bordered system of docs/theory.md, section 3, in a form that serves all of them and stays regular at limit
// points.
CorrectorResult Corrector::iterate(State guess, const PathConstraint& constraint, const Metric& metric,
                                   const Direction& along, double length, const CorrectorOptions& options,
                                   Wanted wanted) {
  CorrectorResult result{.state = std::move(guess)};
  const auto ended = [&](CorrectorStatus status) {
    result.status = status;
    return std::move(result);
  };
  const Row border = metric.row(along);
  double previous = length;
  bool foretold = false;  // that nothing is left
  while (result.iterations < options.max_iterations) {
    if (here_.linearize_at(result.state) == FactorStatus::not_finite) return ended(CorrectorStatus::not_finite);
    if (!find_line(metric, border)) return ended(CorrectorStatus::singular);
    result.roots = constraint.advance(result.state, line_);
    if (!result.roots) return ended(CorrectorStatus::complex_roots);
    const double size = take_step(metric, result.roots->taken, result.state);
    ++result.iterations;
    if (!std::isfinite(size)) return ended(CorrectorStatus::not_finite);
    const double ratio = size / std::max(previous, 1e-300);
    // Newton's next correction, from the last two; from one alone only if the path is nearly straight. That from a long
    // one is not believed before it is made.
    const double next = result.iterations > 1 ? size * ratio * ratio : size * options.straight;
    const bool settled = next <= options.tolerance && ratio <= 1.0;
    const bool is_believed = settled && size * options.inexact <= options.tolerance;
    if (is_believed || (foretold && ratio <= 1.0) || (size <= options.stagnation && ratio > 0.1))
      return arrived(std::move(result), metric, border, wanted);
    foretold = settled;
    const bool is_seen = result.iterations > 1 && size > options.small * length;
    if (is_seen && ratio > options.divergence) return ended(CorrectorStatus::diverged);
    if (is_seen && ratio > 1.0) result.contracts = false;
    previous = size;
  }
  if (foretold || previous <= options.unsettled) {
    if (!foretold) result.unsettled = previous;
    return arrived(std::move(result), metric, border, wanted);
  }
  return ended(CorrectorStatus::too_many_iterations);
}

CorrectorResult Corrector::correct(State guess, const PathConstraint& constraint, const Metric& metric,
                                   const Direction& along, double length, Wanted wanted) {
  return iterate(std::move(guess), constraint, metric, along, length, options_, wanted);
}

CorrectorResult Corrector::correct_patiently(State guess, const PathConstraint& constraint, const Metric& metric,
                                             const Direction& along, double length) {
  CorrectorOptions patient = options_;
  patient.divergence = infinity;
  patient.max_iterations = options_.patient_iterations;
  patient.unsettled = 1e-6;
  return iterate(std::move(guess), constraint, metric, along, length, patient, Wanted::pairs);
}

CorrectorResult Corrector::inspect(const State& state, const Metric& metric, const Direction& along) {
  return arrived({.state = state}, metric, metric.row(along), Wanted::pairs);
}

std::optional<NearNull> Corrector::near_null([[maybe_unused]] const State& here, const Vector& weights, Index count,
                                             Convergence convergence) const {
  assert(!here_.has_point() || here_.is_at(here));
  const Linearization& now = here_.equations();
  const BorderedSolver& solver = here_.solver();
  if (!here_.has_point() || !solver.inner_is_regular() || now.N.nonZeros() > 0) return std::nullopt;
  const Vector weighted = weights.head(now.K.cols());
  if (now.B.cols() > 0) {
    const SlidingStabilityOperator border(solver, now, sliding_resistance(solver, now));
    return border.is_finite() ? std::optional(arcwall::near_null(border, weighted, count, convergence)) : std::nullopt;
  }
  const Matrix none, &known = here_.tracker().vectors();
  const bool followed = known.rows() == now.K.cols() && all_finite(known);
  return arcwall::near_null(solver.inner(), now.K, weighted, count, convergence, followed ? known : none);
}

std::optional<Index> Corrector::count_here(const State& here, const NearNull& nearest) const {
  assert(here_.is_at(here));
  return negative_eigenvalues(system_, here, here_.solver(), here_.equations(), nearest);
}

std::optional<Matrix> Corrector::responses(Matrix columns) const {
  if (!here_.has_point() || !here_.solver().inner_is_regular()) return std::nullopt;
  here_.solver().inner().solve(columns);
  return columns.allFinite() ? std::optional(std::move(columns)) : std::nullopt;
}

// With Cᵀ the unit columns of the y let go: K φ = −Cᵀ η. Where the energy is stationary in s, Cᵀ = B.
Vector Corrector::left_null(const Vector& vector) const {
  const Linearization& now = here_.equations();
  Vector left(now.F.size());
  left.head(now.K.cols()) = vector;
  left.tail(now.B.cols()) = -(now.K.selfadjointView<Eigen::Lower>() * vector)(now.holding);
  for (std::size_t k = 0; k < now.energetic.size(); ++k)
    if (const auto s = static_cast<Index>(k); now.energetic[k])
      left[now.K.cols() + s] = -now.B.col(s).dot(vector) / now.C(s, now.K.cols() + s);
  return left;
}

//   [ J   ψ ] [φ]   [0]
//   [ ψᵀ  0 ] [0] = [1]
std::optional<Vector> Corrector::right_null(const Vector& left) {
  Linearization& now = here_.equations();
  if (now.B.cols() == 0) return left;
  const Vector F_lambda = std::exchange(now.F_lambda, left);
  const auto null = here_.solver().solve({.dx = left, .dlambda = 0.0}, Vector::Zero(left.size()), 1.0);
  now.F_lambda = F_lambda;
  return null ? std::optional(null->dx) : std::nullopt;
}

//   [ J   r ] [y]   [f]
//   [ rᵀ  0 ] [0] = [0]
std::optional<Vector> Corrector::response_across(const Row& row, const Vector& f) {
  Linearization& now = here_.equations();
  Vector F_lambda = std::exchange(now.F_lambda, row.dx);
  const auto y = here_.solver().solve({.dx = row.dx, .dlambda = 0.0}, f, 0.0);
  now.F_lambda = std::move(F_lambda);
  return y ? std::optional(y->dx) : std::nullopt;
}

// The line (1), its tangent of unit length and its particular solution normal to it.
bool Corrector::find_line(const Metric& metric, const Row& border) {
  const std::optional<LineProducts> found = here_.solver().line(border, metric.weights(), line_);
  if (!found) return false;
  const double tt = found->tt + metric.inner_lambda(line_.dlambda[1], line_.dlambda[1]);
  const double pt = found->pt + metric.inner_lambda(line_.dlambda[1], line_.dlambda[0]);
  line_.scale = 1.0 / std::sqrt(tt);
  line_.off = pt / tt;
  return line_.scale > 0.0 && std::isfinite(line_.off);
}

// Along the line, from its point nearest the state. The length of the step.
double Corrector::take_step(const Metric& metric, double tau, State& state) const {
  const auto p = line_.dx.col(0), q = line_.dx.col(1);
  const Vector dx = (p - line_.off * q) + tau * (line_.scale * q);
  state.x += dx;
  const double squared = (metric.weights().array() * dx.array().square()).sum();
  const double dlambda = line_.particular_dlambda() + tau * line_.tangent_dlambda();
  state.lambda += dlambda;
  return std::sqrt(squared + metric.inner_lambda(dlambda, dlambda));
}

CorrectorResult Corrector::arrived(CorrectorResult result, const Metric& metric, const Row& border, Wanted wanted) {
  line_.dx.resize(0, 2);  // room for other columns
  if (here_.set_point(result.state) == FactorStatus::not_finite) {
    result.status = CorrectorStatus::not_finite;
    return result;
  }
  result.status = CorrectorStatus::converged;
  const Linearization& now = here_.equations();
  BorderedSolver& solver = here_.solver();
  const bool alone = !now.is_symmetric() || wanted == Wanted::tangent;
  Matrix columns = alone ? Matrix(now.F.size(), 1) : here_.tracker().right_hand_sides(metric.weights(), 1);
  Direction tangent;
  if (!solver.tangent(border, tangent, columns)) {
    result.status = CorrectorStatus::singular;
    return result;
  }
  result.tangent = unit(metric, std::move(tangent));
  result.residual = relative_residual(metric, now, result.state.lambda, load_floor_);
  if (wanted == Wanted::pairs) add_pairs(result.state, metric, columns.rightCols(columns.cols() - 1), result);
  return result;
}

CorrectorResult Corrector::find_pairs(const State& state, const Metric& metric) {
  CorrectorResult result;
  if (here_.set_point(state) == FactorStatus::not_finite) {
    result.status = CorrectorStatus::not_finite;
    return result;
  }
  Matrix columns;
  if (here_.equations().is_symmetric()) columns = here_.tracker().right_hand_sides(metric.weights());
  const bool solved = here_.solver().inner_is_regular() && columns.cols() > 0 && here_.solver().solve_inner(columns);
  result.status = CorrectorStatus::converged;
  add_pairs(state, metric, columns.leftCols(solved ? columns.cols() : 0), result);
  return result;
}

// At the state reached last, `here`; `solved`: K⁻¹ times what the tracker asked for. Pairs are followed where there is
// no border.
void Corrector::add_pairs(const State& here, const Metric& metric, const Eigen::Ref<const Matrix>& solved,
                          CorrectorResult& result) {
  const BorderedSolver& solver = here_.solver();
  if (!here_.equations().is_symmetric()) {
    result.negative = negative_eigenvalues(system_, here, solver, here_.equations(), {});
    return;
  }
  if (solved.cols() > 0) result.nearest = here_.tracker().advance(metric.weights(), solved);
  if (const auto negative = negative_by_pivots(solver.inner(), metric.weights(), result.nearest))
    result.negative = *negative - system_.multiplier_count(here.active_set);
}

}  // namespace arcwall
