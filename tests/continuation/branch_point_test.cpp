#include "continuation/events/branch_point.hpp"

#include <gtest/gtest.h>

#include "tests/support/functions.hpp"
#include "tests/support/invariants.hpp"

namespace arcwall::branching_test {

namespace {

using test::Branch;
using test::SmoothToy;

State at(double x, double l) { return {.x = test::scalar(x), .lambda = l}; }

TraceOptions until_one() {
  TraceOptions options;
  options.target_values.push_back(test::stop_at_lambda(1.0));
  return options;
}

Event branch_point_of(const System& system) {
  const TraceOptions options = until_one();
  const Branch branch = test::trace(system, options, at(0.0, -1.0));
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  test::expect_branch_invariants(system, branch, options);
  return test::only_event(branch, EventKind::branch_point);
}

}  // namespace

TEST(Branching, APitchforkIsLocatedAndSymmetric) {
  const SmoothToy system = test::pitchfork();
  const Event event = branch_point_of(system);
  EXPECT_NEAR(event.state.lambda, 0.0, 1e-10);
  EXPECT_EQ(event.unstable_before, 0);
  EXPECT_EQ(event.unstable_after, 1);
  ASSERT_NE(event.branching, nullptr);
  EXPECT_EQ(event.branching->type, BranchType::pitchfork);
  EXPECT_EQ(event.branching->multiplicity, 1);
  EXPECT_NEAR(event.branching->mode.dx[0], 1.0, 1e-9);
  // The other branch leaves along the mode: λ = x² is level there.
  EXPECT_NEAR(event.branching->other.dlambda, 0.0, 1e-6);
}

TEST(Branching, ATranscriticalPointIsLocatedAndAsymmetric) {
  const SmoothToy system = test::transcritical();
  const Event event = branch_point_of(system);
  EXPECT_NEAR(event.state.lambda, 0.0, 1e-10);
  ASSERT_NE(event.branching, nullptr);
  EXPECT_EQ(event.branching->type, BranchType::transcritical);
  // x = λ; second derivatives are central differences here.
  EXPECT_NEAR(event.branching->other.dx[0] / event.branching->other.dlambda, 1.0, 1e-5);
}

TEST(Branching, SteppingOffLandsOnTheOtherBranchOnEitherSide) {
  const SmoothToy system = test::pitchfork();
  const Event event = branch_point_of(system);
  ASSERT_NE(event.branching, nullptr);
  const Metric metric(Vector::Ones(1), 1.0);
  Corrector corrector(system, {}, 1.0);
  for (const int sign : {1, -1}) {
    const auto off =
        step_off(system, corrector, metric, *event.branching, way_off(metric, *event.branching, sign), 0.1, 1e-12);
    ASSERT_TRUE(off.has_value());
    EXPECT_GT(sign * off->state.x[0], 0.01);
    EXPECT_NEAR(off->state.lambda, off->state.x[0] * off->state.x[0], 1e-12);
    EXPECT_GT(sign * off->tangent.dx[0], 0.0);
  }
}

TEST(Branching, AFoldIsNoBranchPoint) {
  TraceOptions options;
  options.max_points = 30;
  const Branch branch = test::trace(test::fold(), options, at(1.0, -1.0));
  EXPECT_EQ(test::events_of(branch, EventKind::limit_point).size(), 1U);
  EXPECT_TRUE(test::events_of(branch, EventKind::branch_point).empty());
}

}  // namespace arcwall::branching_test
