#include "tests/support/functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/explore.hpp"
#include "tests/support/invariants.hpp"

// The normal forms of singular points and their unfoldings (Golubitsky & Schaeffer 1985), through the interface that
// structures have. All numbers are closed forms, see tests/support/functions.hpp and toys.hpp.
namespace arcwall::functions_test {

namespace {

using test::Branch;
using test::Graph;

State at(double x, double lambda) { return {.x = test::scalar(x), .lambda = lambda}; }

TraceOptions between(double low, double high, double first_step = 0.02) {
  TraceOptions options;
  options.step.first = first_step;
  options.target_values = {test::stop_at_lambda(low), test::stop_at_lambda(high)};
  return options;
}

struct Fold {
  double x, lambda;
};

// The folds of a branch, which its invariants hold as well.
void expect_folds(const System& system, const Branch& branch, const TraceOptions& options,
                  const std::vector<Fold>& expected, double scale = 1.0) {
  const auto found = events_of(branch, EventKind::limit_point);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].state.lambda, expected[i].lambda, 1e-11 * scale + 1e-12);  // the corrector arrives at 1e-12
    EXPECT_NEAR(found[i].state.x[0], expected[i].x, 1e-8 * scale);
  }
  EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());
  expect_branch_invariants(system, branch, options);
}

}  // namespace

TEST(FoldFunction, IsPassed) {
  const auto system = test::fold();
  const TraceOptions options = between(-2.0, 1.0);
  const Branch branch = test::trace(system, options, at(1.0, -1.0));
  expect_folds(system, branch, options, {{0.0, 0.0}});
  EXPECT_NEAR(branch.last().state.x[0], -std::sqrt(2.0), 1e-12);
}

TEST(TranscriticalFunction, BothBranchesCrossAndExchangeTheirStability) {
  const auto system = test::transcritical();
  const Graph graph = test::explore(system, between(-1.0, 1.0), {.policy = BranchPolicy::all}, at(0.0, -0.9));
  ASSERT_EQ(graph.records.size(), 3U);
  const Event crossing = only_event(graph.branches[0], EventKind::branch_point);
  EXPECT_NEAR(crossing.state.lambda, 0.0, 1e-10);
  EXPECT_EQ(crossing.branching->type, BranchType::transcritical);
  EXPECT_EQ(crossing.unstable_before, 0);
  EXPECT_EQ(crossing.unstable_after, 1);
  // Both ways of x = λ: forward it is stable, backward not.
  for (const std::size_t id : {1U, 2U}) {
    EXPECT_FALSE(graph.records[id].mirror_image);
    const State& end = graph.branches[id].last().state;
    EXPECT_NEAR(std::abs(end.lambda), 1.0, 1e-12);
    EXPECT_NEAR(end.x[0], end.lambda, 1e-12);
    EXPECT_EQ(graph.branches[id].last().count.unstable, Index{end.lambda > 0.0 ? 0 : 1});
  }
  EXPECT_LT(graph.branches[1].last().state.lambda * graph.branches[2].last().state.lambda, 0.0);
}

// e > 0 opens a gap between two folds, e < 0 parts the branches so that none has a fold.
TEST(TranscriticalFunction, UnfoldsIntoFoldsOrNone) {
  for (const double e : {0.1, 1e-3, 1e-5}) {
    SCOPED_TRACE(e);
    const auto gap = test::transcritical(e);
    const TraceOptions options = between(-1.0, 1.0);
    const double root = std::sqrt(e);
    expect_folds(gap, test::trace(gap, options, at(0.5 * (-0.9 + std::sqrt(0.81 - 4.0 * e)), -0.9)), options,
                 {{-root, -2.0 * root}});
    const auto parted = test::transcritical(-e);
    const Branch upper = test::trace(parted, options, at(0.5 * (-0.9 + std::sqrt(0.81 + 4.0 * e)), -0.9));
    expect_folds(parted, upper, options, {});
    EXPECT_NEAR(upper.last().state.x[0], 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * e)), 1e-12);
  }
}

// The first step off the crossing passes the fold. The count that is lost there is known from just behind the crossing.
TEST(TranscriticalFunction, AFoldJustBehindTheCrossingIsFoundOnceWithItsCounts) {
  for (const double e : {0.015, 0.01, 0.003}) {
    SCOPED_TRACE(e);
    const auto system = test::transcritical_beside_fold(e);
    const Graph graph = test::explore(system, between(-1.0, 1.0), {.policy = BranchPolicy::all}, at(0.0, -0.9));
    ASSERT_EQ(graph.records.size(), 3U);
    int folds = 0;
    for (const std::size_t id : {1U, 2U}) {
      EXPECT_TRUE(events_of(graph.branches[id], EventKind::branch_point).empty());
      for (const Event& fold : events_of(graph.branches[id], EventKind::limit_point)) {
        ++folds;
        EXPECT_NEAR(fold.state.lambda, 0.5 * e, 1e-9);
        EXPECT_EQ(fold.unstable_before, 0);
        EXPECT_EQ(fold.unstable_after, 1);
      }
    }
    EXPECT_EQ(folds, 1);
  }
}

TEST(PitchforkFunction, BothSidesAreMirrorImages) {
  const auto system = test::pitchfork();
  const Graph graph = test::explore(system, between(-1.0, 1.0), {.policy = BranchPolicy::all}, at(0.0, -0.9));
  ASSERT_EQ(graph.records.size(), 2U);
  const Event fork = only_event(graph.branches[0], EventKind::branch_point);
  EXPECT_NEAR(fork.state.lambda, 0.0, 1e-10);
  EXPECT_EQ(fork.branching->type, BranchType::pitchfork);
  EXPECT_TRUE(graph.records[1].mirror_image);
  for (const Arc& arc : graph.branches[1].arcs) EXPECT_NEAR(arc.to.state.lambda, std::pow(arc.to.state.x[0], 2), 1e-10);
  EXPECT_EQ(graph.branches[0].last().count.unstable, Index{1});
  EXPECT_EQ(graph.branches[1].last().count.unstable, Index{0});
}

// An imperfection connects the straight branch with one side; the other side ends in a fold.
TEST(PitchforkFunction, UnfoldsIntoASmoothBranchAndAFold) {
  for (const double e : {0.1, 1e-3, 1e-5}) {
    SCOPED_TRACE(e);
    const auto system = test::pitchfork(e);
    const TraceOptions options = between(-1.0, 1.0);
    // On the branch of positive x from x³ + 0.9 x = e; on the other from λ = 1 backwards.
    const State start = test::solved_at(system, at(e / 0.9, -0.9), -0.9, 1);
    expect_folds(system, test::trace(system, options, start), options, {});
    const State behind = test::solved_at(system, at(-1.0, 1.0), 1.0, 1);
    TraceOptions backwards = between(-1.0, 1.0, -0.02);
    const double half = std::cbrt(0.5 * e);
    expect_folds(system, test::trace(system, backwards, behind), backwards, {{-half, 3.0 * half * half}});
  }
}

// x³ − a x + λ: two folds for a > 0, at a = 0 the cusp, where λ is level without turning, none for a < 0.
TEST(CuspFunction, FoldsVanishAtTheCusp) {
  for (const double a : {1.0, 0.1, 1e-2, 1e-3}) {
    SCOPED_TRACE(a);
    const auto system = test::cusp(a);
    const TraceOptions options = between(-1.5, 1.5);
    const State start = test::solved_at(system, at(-1.6, 1.4), 1.4, 1);
    TraceOptions backwards = options;
    backwards.step.first = -0.02;
    const double x = std::sqrt(a / 3.0), lambda = 2.0 * x * x * x;
    expect_folds(system, test::trace(system, backwards, start), backwards, {{-x, -lambda}, {x, lambda}});
  }
  const TraceOptions backwards = between(-1.5, 1.5, -0.02);
  for (const double a : {-1e-3, -0.1}) {
    SCOPED_TRACE(a);
    const auto system = test::cusp(a);
    const State start = test::solved_at(system, at(-1.1, 1.4), 1.4, 1);
    expect_folds(system, test::trace(system, backwards, start), backwards, {});
  }
  const auto cusp = test::cusp(0.0);
  const Branch level = test::trace(cusp, backwards, test::solved_at(cusp, at(-1.1, 1.4), 1.4, 1));
  EXPECT_TRUE(only_event(level, EventKind::limit_point).unconfirmed);
}

TEST(IsolaFunction, IsPassedOnceAroundHoweverSmall) {
  for (const double r : {1.0, 1e-2, 1e-4}) {
    SCOPED_TRACE(r);
    const auto system = test::isola(r);
    TraceOptions options;
    options.step.first = 0.02 * r;
    options.step.max = 0.2 * r;
    const Branch branch = test::trace(system, options, at(0.6 * r, 0.8 * r));
    EXPECT_EQ(branch.end.reason, EndReason::closed_loop);
    expect_folds(system, branch, options, {{0.0, r}, {0.0, -r}}, r);
  }
}

// The path crosses itself at 0, where the other lobe begins: on the lobe of λ > 0 from x = 0.3, where 2 λ² = 1 − 2 x² +
// √(1 − 8 x²).
TEST(LemniscateFunction, CrossesItself) {
  const auto system = test::lemniscate();
  const double x = 0.3, lambda = std::sqrt(0.5 * (1.0 - 2.0 * x * x + std::sqrt(1.0 - 8.0 * x * x)));
  const Graph graph = test::explore(system, {}, {.policy = BranchPolicy::all}, at(x, lambda));
  const Branch& branch = graph.branches[0];
  const auto crossing = events_of(branch, EventKind::branch_point);
  ASSERT_FALSE(crossing.empty());
  EXPECT_NEAR(crossing[0].state.lambda, 0.0, 1e-9);
  EXPECT_NEAR(crossing[0].state.x[0], 0.0, 1e-9);
  std::vector<double> folds;
  for (const Event& event : events_of(branch, EventKind::limit_point)) folds.push_back(event.state.lambda);
  std::sort(folds.begin(), folds.end());
  ASSERT_EQ(folds.size(), 2U);
  EXPECT_NEAR(folds[0], -1.0, 1e-11);
  EXPECT_NEAR(folds[1], 1.0, 1e-11);
  EXPECT_EQ(branch.end.reason, EndReason::closed_loop);
}

}  // namespace arcwall::functions_test
