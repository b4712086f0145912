#include "continuation/corners/outgoing_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/algebra/dense.hpp"

namespace arcwall {

namespace {

// The rate problem in the degenerate contacts' guards: ġ + c ṗ = σ a + M ṗ, c their compliances. σ is the rate of λ, or
// where K with all of them open is nearly singular that of one of their gaps. Of a large problem some contacts may be
// held closed instead: ġ + c ṗ and ṗ change places there (a principal pivot), and complementarity stays.
struct RateProblem {
  State open{};                       // the corner with all degenerate contacts open but those held
  std::vector<bool> held{};           // of the degenerate contacts
  Direction free_rate{};              // for σ = 1 without degenerate forces, nor gaps of those held
  std::vector<Direction> response{};  // for unit degenerate forces, and unit gaps of those held
  Vector a{};
  Matrix M{};
};

// σ and the rates of the degenerate contacts' forces, of those held the rates of their gaps.
struct Solution {
  double sigma;
  Vector p;
};

// Fills in a and M from how the structure answers.
bool add_gap_rates(const UnilateralSystem& system, const std::vector<Index>& degenerate, RateProblem& problem) {
  const auto w = static_cast<Index>(degenerate.size());
  problem.a.resize(w);
  problem.M.resize(w, w);
  for (Index i = 0; i < w; ++i) {
    const Index contact = degenerate[static_cast<std::size_t>(i)];
    const Row gap = system.guard_gradient(problem.open, contact);
    problem.a[i] = apply(gap, problem.free_rate);
    for (Index j = 0; j < w; ++j) problem.M(i, j) = apply(gap, problem.response[static_cast<std::size_t>(j)]);
    if (!problem.held[static_cast<std::size_t>(i)])
      problem.M(i, i) += system.enforcement(problem.open.active_set, contact).compliance;
  }
  return problem.a.allFinite() && problem.M.allFinite();
}

// Whether what resists a motion that the right-hand side makes is told from round-off to a few digits.
bool is_resisted_surely(const Factorization& K, const Linearization& now, const Eigen::Ref<const Vector>& motion,
                        const Eigen::Ref<const Vector>& right) {
  constexpr double digits = 1e4;
  const Index n = now.K.cols();
  return std::abs(motion.dot(right)) >= digits * K.roundoff(motion.head(n));
}

// With σ the rate of the gap of one of the degenerate contacts in place of that of λ: just behind a pitchfork K with
// all of them open is nearly singular, but hardly anything moves without that gap.
std::optional<RateProblem> reduce_by_gap(const UnilateralSystem& system, RateProblem problem,
                                         const std::vector<Index>& degenerate, Index held, CornerWorkspace& workspace) {
  const Row border = system.guard_gradient(problem.open, degenerate[static_cast<std::size_t>(held)]);
  const auto free = workspace.solver.solve(border, Vector::Zero(workspace.equations.F.size()), 1.0);
  if (!free) return std::nullopt;
  problem.free_rate = *free;
  problem.response.clear();
  for (const Index j : degenerate) {
    auto response = workspace.solver.solve(border, system.unit_force(problem.open, j), 0.0);
    if (!response) return std::nullopt;
    problem.response.push_back(std::move(*response));
  }
  if (!add_gap_rates(system, degenerate, problem)) return std::nullopt;
  return problem;
}

// The force of an open contact, or the change of the equation of one that is held, by which its guard changes by one.
Vector unit_cause(const UnilateralSystem& system, const State& corner, const State& open, Index contact) {
  const Enforcement how = system.enforcement(open.active_set, contact);
  if (!how.multiplier) return system.unit_force(open, contact);
  const State all_open = system.with_active_set(corner, corner.active_set.all_open());
  const double length = system.unit_force(all_open, contact).norm() /
                        (system.guard_gradient(all_open, contact).dx.norm() * how.force_scale);
  return -length * Vector::Unit(open.x.size(), *how.multiplier);
}

// With those contacts held; `unresisted` is the one whose motion is not told from round-off, if there is one.
struct Reduced {
  std::optional<RateProblem> problem{};
  std::optional<std::size_t> unresisted{};
};

Reduced reduce_with_held(const UnilateralSystem& system, const State& corner, const std::vector<Index>& degenerate,
                         std::vector<bool> held, CornerWorkspace& workspace) {
  RateProblem problem{.held = std::move(held)};
  ActiveSet active_set = corner.active_set;
  for (std::size_t i = 0; i < degenerate.size(); ++i)
    active_set[static_cast<std::size_t>(degenerate[i])] = problem.held[i] ? 1 : 0;
  problem.open = system.with_active_set(corner, active_set);
  auto& [now, solver] = workspace;
  system.linearize(problem.open, now);
  const auto first_open =
      static_cast<std::size_t>(std::find(problem.held.begin(), problem.held.end(), false) - problem.held.begin());
  const FactorStatus status = solver.factorize(now, system.multiplier_count(active_set));
  if (status == FactorStatus::not_finite) return {};
  const auto w = static_cast<Index>(degenerate.size());
  Matrix right(now.F.size(), 1 + w);
  right.col(0) = -now.F_lambda;
  for (Index i = 0; i < w; ++i)
    right.col(1 + i) = unit_cause(system, corner, problem.open, degenerate[static_cast<std::size_t>(i)]);
  Matrix X = right;
  if (status != FactorStatus::ok || !solver.solve_inner(X))
    return {.problem = std::move(problem), .unresisted = first_open};
  problem.free_rate = {.dx = X.col(0), .dlambda = 1.0};
  for (Index i = 0; i < w; ++i) problem.response.push_back({.dx = X.col(1 + i), .dlambda = 0.0});
  if (!add_gap_rates(system, degenerate, problem)) return {};
  std::size_t softest = first_open;
  for (std::size_t i = first_open; i < degenerate.size(); ++i) {
    const auto of = [&](std::size_t k) { return std::abs(problem.M(static_cast<Index>(k), static_cast<Index>(k))); };
    if (!problem.held[i] && of(i) > of(softest)) softest = i;
  }
  Reduced reduced;
  if (softest < degenerate.size()) {
    const auto column = 1 + static_cast<Index>(softest);
    if (!is_resisted_surely(solver.inner(), now, X.col(column), right.col(column))) reduced.unresisted = softest;
  }
  reduced.problem = std::move(problem);
  return reduced;
}

// Where next to nothing resists without the degenerate contacts, of a small problem the rate of a gap takes the place
// of that of λ; of a large one so many contacts are held that the structure resists whatever the others do.
std::optional<RateProblem> reduce(const UnilateralSystem& system, const State& corner,
                                  const std::vector<Index>& degenerate, bool small, CornerWorkspace& workspace) {
  std::vector<bool> held(degenerate.size(), false);
  for (;;) {
    Reduced reduced = reduce_with_held(system, corner, degenerate, held, workspace);
    if (!reduced.problem || !reduced.unresisted) return std::move(reduced.problem);
    if (*reduced.unresisted >= degenerate.size()) return std::nullopt;
    if (small)
      return reduce_by_gap(system, std::move(*reduced.problem), degenerate, static_cast<Index>(*reduced.unresisted),
                           workspace);
    held[*reduced.unresisted] = true;
  }
}

// The direction (σ, ṗ_A) with ġ_A + c ṗ_A = 0 and ṗ = 0 outside A: the null vector of [a_A M_AA], up to its length and
// sign.
Solution direction_with(const RateProblem& problem, const std::vector<Index>& active) {
  const auto k = static_cast<Index>(active.size());
  Solution solution{.sigma = 1.0, .p = Vector::Zero(problem.a.size())};
  if (k == 0) return solution;
  Matrix A(k, k + 1);
  for (Index i = 0; i < k; ++i) {
    A(i, 0) = problem.a[active[static_cast<std::size_t>(i)]];
    for (Index j = 0; j < k; ++j)
      A(i, j + 1) = problem.M(active[static_cast<std::size_t>(i)], active[static_cast<std::size_t>(j)]);
  }
  // σ and forces are found in units in which both move the gaps alike, so that neither is round-off beside the other.
  const double of_sigma = A.col(0).norm(), of_forces = A.rightCols(k).norm() / std::sqrt(double(k));
  const double unit = of_sigma > 0.0 && of_forces > 0.0 ? of_sigma / of_forces : 1.0;
  A.rightCols(k) *= unit;
  const Vector null = null_vector(A);
  solution.sigma = null[0];
  for (Index j = 0; j < k; ++j) solution.p[active[static_cast<std::size_t>(j)]] = unit * null[j + 1];
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
    found.push_back({.sigma = -forward.sigma, .p = -forward.p});
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
  if (!is_positive_definite(M))
    for (Index j = 0; j < w; ++j) {
      covers.push_back(Vector::Ones(w));
      covers.back()[j] = 8.0;
    }
  for (const double sign : {1.0, -1.0})
    for (const Vector& cover : covers)
      if (const auto p = lemke(M, sign * problem.a, cover)) found.push_back({.sigma = sign, .p = *p / scale});
  return found;
}

// How fast the structure moves with σ: by itself, or as one of the contacts alone makes it follow. Where only walls
// move nothing moves by itself.
double greatest_motion(const RateProblem& problem) {
  double greatest = problem.free_rate.dx.norm();
  for (Index i = 0; i < problem.a.size(); ++i) {
    const double force = std::abs(problem.a[i] / problem.M(i, i));
    if (std::isfinite(force))
      greatest = std::max(greatest, force * problem.response[static_cast<std::size_t>(i)].dx.norm());
  }
  return std::max(greatest, std::numeric_limits<double>::min());
}

// The direction of a solution in the unknowns of its own active set; none if a rate has the wrong sign.
std::vector<OutgoingDirection> direction_of(const UnilateralSystem& system, const State& corner,
                                            const std::vector<Index>& degenerate, const RateProblem& problem,
                                            const Solution& solution, const CornerOptions& options) {
  Direction motion{.dx = solution.sigma * problem.free_rate.dx, .dlambda = solution.sigma * problem.free_rate.dlambda};
  for (Index i = 0; i < solution.p.size(); ++i) {
    const Direction& response = problem.response[static_cast<std::size_t>(i)];
    motion.dx += solution.p[i] * response.dx;
    motion.dlambda += solution.p[i] * response.dlambda;
  }
  Vector p = solution.p, gap_rate = solution.sigma * problem.a + problem.M * solution.p;
  for (std::size_t i = 0; i < problem.held.size(); ++i)
    if (problem.held[i]) std::swap(p[static_cast<Index>(i)], gap_rate[static_cast<Index>(i)]);
  double length = std::hypot(motion.dx.norm() / greatest_motion(problem), solution.sigma);
  if (length == 0.0) length = std::abs(motion.dlambda);  // the load grows and nothing moves
  if (!(length > 0.0)) return {};
  p /= length;
  gap_rate /= length;
  motion.dx /= length;
  motion.dlambda /= length;
  double most = 0.0;
  for (Index i = 0; i < p.size(); ++i)
    most = std::max(most, std::abs(problem.held[static_cast<std::size_t>(i)] ? gap_rate[i] : problem.a[i]));
  const double g_zero = options.rate_tolerance * std::max(most, 1e-300);
  const double p_zero = options.rate_tolerance * std::max(p.cwiseAbs().maxCoeff(), 1e-300);
  if ((p.array() < -p_zero).any() || (gap_rate.array() < -g_zero).any()) return {};

  OutgoingDirection way;
  way.wrong_rate = std::max({-p.minCoeff() / p_zero, -gap_rate.minCoeff() / g_zero, 0.0});
  way.active_set = corner.active_set;
  way.loading = ActiveSet(corner.active_set.size(), 0);
  for (Index i = 0; i < p.size(); ++i) {
    const auto j = static_cast<std::size_t>(degenerate[static_cast<std::size_t>(i)]);
    if (p[i] > p_zero) way.active_set[j] = way.loading[j] = 1;
    if (p[i] <= p_zero && gap_rate[i] > g_zero) way.active_set[j] = 0;
  }
  way.direction.dlambda = motion.dlambda;
  way.direction.dx = system.transfer(motion.dx, problem.open.active_set, way.active_set);
  for (Index i = 0; i < p.size(); ++i)
    if (const Enforcement how = system.enforcement(way.active_set, degenerate[static_cast<std::size_t>(i)]);
        how.multiplier)
      way.direction.dx[*how.multiplier] = p[i] * how.force_scale;
  return {std::move(way)};
}

// The way on in which these of the degenerate contacts are closed and λ grows or falls, by the equations of that active
// set alone; none if a rate has the wrong sign.
std::vector<OutgoingDirection> way_on_active_set(const UnilateralSystem& system, const State& corner,
                                                 const std::vector<Index>& degenerate, unsigned closed, double sign,
                                                 const CornerOptions& options, CornerWorkspace& workspace) {
  ActiveSet active_set = corner.active_set;
  for (std::size_t i = 0; i < degenerate.size(); ++i)
    active_set[static_cast<std::size_t>(degenerate[i])] = static_cast<std::uint8_t>(closed >> i & 1U);
  const State here = system.with_active_set(corner, active_set);
  auto& [now, solver] = workspace;
  system.linearize(here, now);
  if (solver.factorize(now, system.multiplier_count(active_set)) != FactorStatus::ok) return {};
  Matrix X = -sign * now.F_lambda;
  if (!solver.solve_inner(X)) return {};
  const Direction motion{.dx = X.col(0), .dlambda = sign};
  const double moves = std::sqrt((system.weights(active_set).array() * motion.dx.array().square()).sum());
  Vector rates(static_cast<Index>(degenerate.size()));
  double loads = 0.0;  // the greatest rate of a force
  for (std::size_t i = 0; i < degenerate.size(); ++i) {
    rates[static_cast<Index>(i)] = apply(system.guard_gradient(here, degenerate[i]), motion);
    if (closed >> i & 1U) loads = std::max(loads, std::abs(rates[static_cast<Index>(i)]));
  }
  OutgoingDirection way;
  way.active_set = corner.active_set;
  way.loading = ActiveSet(corner.active_set.size(), 0);
  for (std::size_t i = 0; i < degenerate.size(); ++i) {
    const bool is_closed = (closed >> i & 1U) != 0;
    const double zero = options.rate_tolerance * (is_closed ? loads : moves), rate = rates[static_cast<Index>(i)];
    const auto j = static_cast<std::size_t>(degenerate[i]);
    if (rate < -zero) return {};
    if (rate < 0.0) way.wrong_rate = std::max(way.wrong_rate, -rate / zero);
    if (rate <= zero) continue;
    way.active_set[j] = way.loading[j] = static_cast<std::uint8_t>(is_closed);
  }
  const double length = std::hypot(moves, 1.0);
  way.direction = {.dx = system.transfer(motion.dx / length, active_set, way.active_set), .dlambda = sign / length};
  return {std::move(way)};
}

// Where next to nothing but degenerate contacts resists a motion, K with all of them open says nothing of the rest.
// The last active set that is tried has all of them closed.
std::vector<OutgoingDirection> ways_by_active_set(const UnilateralSystem& system, const State& corner,
                                                  const std::vector<Index>& degenerate, const CornerOptions& options,
                                                  CornerWorkspace& workspace) {
  constexpr std::size_t most = 6;  // contacts up to which all active sets are tried
  std::vector<OutgoingDirection> found;
  if (degenerate.size() > most) return found;
  const unsigned all = (1U << degenerate.size()) - 1U;
  for (const double sign : {1.0, -1.0})
    for (unsigned closed = 0; closed <= all; ++closed)
      for (OutgoingDirection& way : way_on_active_set(system, corner, degenerate, closed, sign, options, workspace))
        found.push_back(std::move(way));
  return found;
}

// Whether two directions move the structure, whose unknowns are the first n, alike; contact forces follow from that.
bool same(const UnilateralSystem& system, Index n, const OutgoingDirection& a, const OutgoingDirection& b,
          double tolerance) {
  const Vector weights = system.weights(a.active_set);
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
  const bool small = static_cast<int>(degenerate.size()) <= options.max_enumerated;
  std::vector<OutgoingDirection> found;
  Index n = 0;  // unknowns of the structure
  const auto add = [&](OutgoingDirection& way) {
    const auto known = std::find_if(found.begin(), found.end(), [&](const OutgoingDirection& other) {
      return same(system, n, way, other, options.same_direction);
    });
    if (known == found.end())
      found.push_back(std::move(way));
    else if (way.wrong_rate < known->wrong_rate)
      *known = std::move(way);
  };
  std::vector<OutgoingDirection> ways;
  if (options.max_enumerated == 0) ways = ways_by_active_set(system, corner, degenerate, options, workspace);
  if (!ways.empty()) {
    ActiveSet all = corner.active_set;
    for (const Index j : degenerate) all[static_cast<std::size_t>(j)] = 1;
    n = workspace.equations.K.cols() - system.multiplier_count(all);
  } else if (const auto problem = reduce(system, corner, degenerate, small, workspace)) {
    n = workspace.equations.K.cols() - system.multiplier_count(problem->open.active_set);
    for (const Solution& solution : small ? enumerate(*problem) : pivoted(*problem))
      for (OutgoingDirection& way : direction_of(system, corner, degenerate, *problem, solution, options))
        ways.push_back(std::move(way));
  }
  for (OutgoingDirection& way : ways) add(way);
  return found;
}

}  // namespace arcwall
