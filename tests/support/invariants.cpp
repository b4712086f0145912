#include "tests/support/invariants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/stability.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// What the unknowns may be off by: the corrector stops when its estimate of the distance that is left is below its
// tolerance in the path metric (an estimate: four times that is allowed), and arithmetic on x is sure to a few ε. In
// forces that is |K| times as much, which grows like EI/h³ with finer meshes although the displacements are as good as
// before.
Vector residual_allowance(const System& system, const State& state, const Linearization& now,
                          const TraceOptions& options, double lambda_scale) {
  const Vector weights = system.weights(state.active_set);
  const double tolerance = 4.0 * options.corrector.tolerance;
  Vector off(state.x.size());
  for (Index i = 0; i < off.size(); ++i) {
    const double left = weights[i] > 0.0 ? tolerance / std::sqrt(weights[i]) : 0.0;
    off[i] = left + 16.0 * epsilon * std::abs(state.x[i]);
  }
  SparseMatrix magnitude = now.K;
  magnitude.coeffs() = magnitude.coeffs().abs();
  return magnitude.selfadjointView<Eigen::Lower>() * off +
         (tolerance * lambda_scale + 16.0 * epsilon * std::abs(state.lambda)) * now.F_lambda.cwiseAbs();
}

void expect_equilibrium(const System& system, const PathPoint& point, const TraceOptions& options,
                        double lambda_scale) {
  Linearization now;
  system.linearize(point.state, now);
  const Vector allowed = residual_allowance(system, point.state, now, options, lambda_scale);
  Index worst = 0;
  const double excess = (now.F.cwiseAbs() - allowed).maxCoeff(&worst);
  EXPECT_LE(excess, 0.0) << "unknown " << worst << ": |F| = " << std::abs(now.F[worst]) << ", allowed "
                         << allowed[worst];
}

void expect_side_conditions(const System& system, const PathPoint& point, double tolerance) {
  if (point.state.active_set.size() == 0) return;
  const Vector guards = system.guards(point.state);
  EXPECT_GE(guards.minCoeff(), -tolerance) << "a gap is negative or a contact pulls";
  const ActiveSet open = point.state.active_set.all_open();
  Vector gaps = system.guards(system.with_active_set(point.state, open));
  for (Index j = 0; j < gaps.size(); ++j) {
    const bool closed = point.state.active_set[static_cast<std::size_t>(j)] != 0;
    if (closed) gaps[j] += system.enforcement(open, j).compliance * guards[j];  // as far as springs give way
    EXPECT_GE(gaps[j], -4.0 * tolerance) << "contact " << j << " penetrates";
    EXPECT_LE(gaps[j], closed ? 4.0 * tolerance : infinity) << "the closed contact " << j << " has a gap";
  }
}

// A singular matrix has no sure count: at located limit and branch points nothing is compared.
bool singular_here(const Arc& arc) {
  return std::any_of(arc.events.begin(), arc.events.end(), [](const Event& event) {
    return event.kind == EventKind::limit_point || event.kind == EventKind::branch_point;
  });
}

void expect_count(const System& system, const Arc& arc, const TraceOptions& options) {
  if (singular_here(arc) || !arc.to.count.unstable) return;
  // Right behind a corner the contacts of the ray that is taken are closed already though they carry nothing yet: the
  // count stored there is that of the ray.
  const bool corner = std::any_of(arc.events.begin(), arc.events.end(), [](const Event& event) {
    return event.kind == EventKind::contact_closes || event.kind == EventKind::contact_opens;
  });
  if (corner) return;
  const ActiveSet strong = strictly_active(system, arc.to.state, options.guard_tolerance);
  const auto dense = dense_unstable_count(system, system.with_active_set(arc.to.state, strong));
  if (dense) {
    EXPECT_EQ(*arc.to.count.unstable, *dense);
  }
}

void expect_extremum(const Event& event, const PathPoint& before, const PathPoint& after) {
  const double rise = event.state.lambda - before.state.lambda, fall = event.state.lambda - after.state.lambda;
  // Events are localised to 1e-10 in λ, or better; a bracket may say less than a tangent near a singular point is sure.
  const double bracket = std::max(event.lambda_uncertainty, 1e-10 * std::max(1.0, std::abs(event.state.lambda)));
  EXPECT_TRUE((rise >= -bracket && fall >= -bracket) || (rise <= bracket && fall <= bracket))
      << "lambda " << before.state.lambda << " -> " << event.state.lambda << " -> " << after.state.lambda;
  EXPECT_GE(event.lambda_uncertainty, 0.0);
  EXPECT_LE(event.lambda_uncertainty, 1e-10 * std::max(1.0, std::abs(event.state.lambda)));
}

void expect_changes(const Event& event, const ActiveSet& before, const ActiveSet& after) {
  if (event.kind != EventKind::contact_closes && event.kind != EventKind::contact_opens) return;
  EXPECT_FALSE(event.guards.empty());
  for (const Index j : event.guards) {
    EXPECT_EQ(before[static_cast<std::size_t>(j)] != 0, event.kind == EventKind::contact_opens);
    EXPECT_EQ(after[static_cast<std::size_t>(j)] != 0, event.kind == EventKind::contact_closes);
  }
}

// As above with a border: s is sought to the same relative accuracy as positions, moments vanish to round-off.
Vector bordered_allowance(const SlidingContact& system, const State& state, const Linearization& now,
                          const TraceOptions& options, double lambda_scale) {
  const Vector weights = system.weights(state.active_set);
  const double tolerance = 4.0 * options.corrector.tolerance, L = system.scales().length;
  const Index n = state.x.size(), m = mesh_of(state).breakpoints(), core = n - m;
  Vector off(n);
  for (Index i = 0; i < n; ++i) {
    const double left = weights[i] > 0.0 ? tolerance / std::sqrt(weights[i]) : i >= core ? tolerance * L : 0.0;
    off[i] = left + 16.0 * epsilon * std::abs(state.x[i]);
  }
  SparseMatrix magnitude = now.K;
  magnitude.coeffs() = magnitude.coeffs().abs();
  const double lambda_off = tolerance * lambda_scale + 16.0 * epsilon * std::abs(state.lambda);
  Vector allowed(n);
  allowed.head(core) = magnitude.selfadjointView<Eigen::Lower>() * off.head(core) + now.B.cwiseAbs() * off.tail(m) +
                       lambda_off * now.F_lambda.head(core).cwiseAbs();
  allowed.tail(m).setConstant(options.guard_tolerance * system.scales().force * L);
  return allowed;
}

bool changes_here(const Arc& arc) {
  return std::any_of(arc.events.begin(), arc.events.end(), [](const Event& event) {
    return event.kind != EventKind::start && event.kind != EventKind::turning_point;
  });
}

}  // namespace

void expect_sliding_invariants(const SlidingContact& system, const std::vector<Arc>& arcs, const TraceOptions& options,
                               double lambda_scale, const InvariantOptions& what) {
  ASSERT_FALSE(arcs.empty());
  // Between nodes the path is kept out of walls to 1e-9 of the length scale, by the cubic through the gaps and slopes
  // of the nodes. The elements' own shapes differ from it by 1/100 of the element length times the cube of its end
  // slopes: 1e-9 on the meshes here.
  constexpr double between = 2e-9;
  constexpr int places = 20;
  Linearization now;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const State& state = arcs[i].to.state;
    SCOPED_TRACE("point " + std::to_string(i) + ", lambda = " + std::to_string(state.lambda));
    ASSERT_EQ(state.x.size(), system.size(state.active_set));
    now = {};
    system.linearize(state, now);
    const Vector allowed = bordered_allowance(system, state, now, options, lambda_scale);
    Index worst = 0;
    const double excess = (now.F.cwiseAbs() - allowed).maxCoeff(&worst);
    EXPECT_LE(excess, 0.0) << "unknown " << worst << ": |F| = " << std::abs(now.F[worst]) << ", allowed "
                           << allowed[worst];
    Index lowest = 0;
    if (system.guard_count(state.active_set) > 0) {
      const double least = system.guards(state).minCoeff(&lowest);
      EXPECT_GE(least, -4.0 * options.guard_tolerance) << "guard " << lowest << " of " << state.active_set.size();
    }
    EXPECT_GE(system.least_gap(state, places), -between * system.scales().length);
    if (i % static_cast<std::size_t>(what.recount_every) == 0 && arcs[i].to.count.unstable && !changes_here(arcs[i]))
      if (const auto dense = dense_unstable_count(system, state, options.guard_tolerance)) {
        EXPECT_EQ(*arcs[i].to.count.unstable, *dense);
      }
    if (i > 0) {
      EXPECT_GE(arcs[i].to.arc, arcs[i - 1].to.arc);
    }
    if (::testing::Test::HasFailure()) return;  // the first violation says enough
  }
}

void expect_branch_invariants(const System& system, const Branch& branch, const TraceOptions& options,
                              const InvariantOptions& what) {
  ASSERT_FALSE(branch.arcs.empty());
  for (std::size_t i = 0; i < branch.arcs.size(); ++i) {
    SCOPED_TRACE("point " + std::to_string(i) + ", lambda = " + std::to_string(branch.arcs[i].to.state.lambda));
    const Arc& arc = branch.arcs[i];
    ASSERT_EQ(arc.to.state.x.size(), system.size(arc.to.state.active_set));
    expect_equilibrium(system, arc.to, options, branch.lambda_scale);
    expect_side_conditions(system, arc.to, options.guard_tolerance);
    if (i % static_cast<std::size_t>(what.recount_every) == 0) expect_count(system, arc, options);
    if (i == 0) continue;
    const Arc& before = branch.arcs[i - 1];
    EXPECT_GE(arc.to.arc, before.to.arc);
    if (arc.to.state.x.size() == before.to.state.x.size()) {
      const Metric metric(system.weights(arc.to.state.active_set), branch.lambda_scale);
      const Vector moved = arc.to.state.x - before.to.state.x;
      EXPECT_LE(std::sqrt(metric.inner_x(moved, moved)), 2.0 * options.step.max);
    }
    for (const Event& event : arc.events) {
      EXPECT_EQ(event.arc, arc.to.arc);
      expect_changes(event, before.to.state.active_set, arc.to.state.active_set);
      if (event.kind == EventKind::limit_point && options.events == EventSearch::locate && i + 1 < branch.arcs.size())
        expect_extremum(event, before.to, branch.arcs[i + 1].to);
    }
    if (::testing::Test::HasFailure()) return;  // the first violation says enough
  }
}

}  // namespace arcwall::test
