// The first points of active sets pass every check that other points pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuation/tracer.hpp"
#include "tests/support/branch.hpp"
#include "tests/support/layout_toys.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::first_points_test {

namespace {

using test::Branch;
using test::events_of;
using test::only_event;
using test::RemeshingToy;
using test::SpreadingToy;
using test::stop_at_lambda;
using test::trace;

struct First final : Observable {
  double value(const State& s) const override { return s.x[0]; }
  Row gradient(const State& s) const override { return {.dx = Vector::Unit(s.x.size(), 0), .dlambda = 0.0}; }
};

TargetValue at_lambda(double value) { return {.quantity = std::make_shared<ParameterValue>(), .value = value}; }
TargetValue at_x(double value) { return {.quantity = std::make_shared<First>(), .value = value}; }
TargetValue stop_at_x(double value) {
  return {.quantity = std::make_shared<First>(), .value = value, .stops = true, .label = "x"};
}

constexpr double landed = 1e-11;  // of the value, as for values inside a step

std::ptrdiff_t points_at(const Branch& branch, const TargetValue& target) {
  return std::count_if(branch.arcs.begin(), branch.arcs.end(), [&](const Arc& arc) {
    return std::abs(target.quantity->value(arc.to.state) - target.value) <= landed;
  });
}

void expect_equilibria(const System& system, const Branch& branch) {
  for (const Arc& arc : branch.arcs) {
    Vector F(arc.to.state.x.size());
    system.residual(arc.to.state, F);
    EXPECT_LE(F.norm(), 1e-12) << "at lambda = " << arc.to.state.lambda;
  }
}

void expect_growing_arcs(const Branch& branch) {
  for (std::size_t i = 1; i < branch.arcs.size(); ++i) EXPECT_GE(branch.arcs[i].to.arc, branch.arcs[i - 1].to.arc);
}

// c = ½: λ grows up to x = 1.29. The first point behind the bound at λ = 1 has x = 1.2, λ = 1.168; on the way back the
// bound is at x = 1.1, λ = 1.096.
SpreadingToy gentle() { return {0.5, 0.4}; }

// The span is resolved from 1/16 of its first length on; nearer to the bound the point's active set serves, which
// misses x by c (d₀/16)³ at most.
constexpr double missed = 0.5 * 0.025 * 0.025 * 0.025;

}  // namespace

TEST(FirstPoints, ABoundJustBehindATransitionIsLandedOn) {
  const SpreadingToy system = gentle();
  for (const double bound : {1.0 + 1e-9, 1.0001, 1.01, 1.02, 1.05, 1.1, 1.16, 1.1679}) {
    SCOPED_TRACE(bound);
    const Branch branch = trace(system, {.target_values = {stop_at_lambda(bound)}});
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_NEAR(branch.last().state.lambda, bound, landed);
    const double x = branch.last().state.x[0];
    EXPECT_NEAR(system.lambda_on_span(x), bound, missed + landed);
    EXPECT_EQ(branch.last().count.unstable, 0);
    EXPECT_LE(events_of(branch, EventKind::contact_spreads).size(), 1U);
    expect_equilibria(system, branch);
    expect_growing_arcs(branch);
  }
}

TEST(FirstPoints, ABoundJustBehindTheWayBackIsLandedOn) {
  const SpreadingToy system = gentle();
  for (const double bound : {1.0959, 1.09, 1.05, 1.01, 1.0 + 1e-9}) {
    SCOPED_TRACE(bound);
    const TraceOptions options{.step = {.first = -0.02}, .target_values = {stop_at_lambda(bound)}};
    const Branch branch = trace(system, options, system.on_span(1.25));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_NEAR(branch.last().state.lambda, bound, landed);
    EXPECT_NEAR(system.lambda_on_span(branch.last().state.x[0]), bound, landed) << "on the span, which is not gone yet";
    if (bound > 1.001) {
      EXPECT_TRUE(events_of(branch, EventKind::contact_shrinks).empty());
    }
    expect_equilibria(system, branch);
    expect_growing_arcs(branch);
  }
}

// Values of λ and of a monitor, in any order: each is met once, and the path goes on.
TEST(FirstPoints, EveryTargetValueBehindATransitionIsMetOnce) {
  const SpreadingToy system = gentle();
  const std::vector<TargetValue> targets{at_lambda(1.004), at_lambda(1.05), at_x(1.06),
                                         at_x(1.003),      at_x(1.11),      at_lambda(1.15)};
  for (const bool back : {false, true}) {
    SCOPED_TRACE(back ? "back" : "forward");
    TraceOptions options{.step = {.first = back ? -0.02 : 0.02}, .target_values = targets};
    options.target_values.push_back(back ? stop_at_lambda(0.9) : stop_at_x(1.25));
    const Branch branch = trace(system, options, back ? system.on_span(1.25) : test::rest(system));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    for (std::size_t i = 0; i < targets.size(); ++i) EXPECT_EQ(points_at(branch, targets[i]), 1) << "target " << i;
    EXPECT_EQ(events_of(branch, EventKind::contact_spreads).size(), back ? 0U : 1U);
    EXPECT_EQ(events_of(branch, EventKind::contact_shrinks).size(), back ? 1U : 0U);
    expect_equilibria(system, branch);
    expect_growing_arcs(branch);
  }
}

// c = 25/6: λ turns at x = 1.1, λ = 1.0666…, before the first point, which has x = 1.2, λ = 0.9333….
TEST(FirstPoints, ALimitPointBeforeTheFirstPointIsLocated) {
  const SpreadingToy system(25.0 / 6.0, 0.4);
  const Branch branch = trace(system, {.target_values = {stop_at_x(1.25)}});
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  const Event limit = only_event(branch, EventKind::limit_point);
  EXPECT_NEAR(limit.state.x[0], 1.1, 1e-9);
  EXPECT_NEAR(limit.state.lambda, 1.1 - 1.0 / 30.0, 1e-12);
  EXPECT_EQ(limit.unstable_before, 0);
  EXPECT_EQ(limit.unstable_after, 1);
  const Event spreads = only_event(branch, EventKind::contact_spreads);
  EXPECT_NEAR(spreads.state.lambda, 1.0, 1e-12);
  EXPECT_EQ(spreads.unstable_after, 0);
  EXPECT_TRUE(events_of(branch, EventKind::contact_limit_point).empty());
  EXPECT_EQ(branch.last().count.unstable, 1);
}

TEST(FirstPoints, ABoundThatAFoldBeforeTheFirstPointReachesIsLandedOn) {
  const SpreadingToy system(25.0 / 6.0, 0.4);
  const Branch branch = trace(system, {.target_values = {stop_at_lambda(1.06)}});
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.lambda, 1.06, landed);
  EXPECT_LT(branch.last().state.x[0], 1.1) << "before the fold";
}

TEST(FirstPoints, AnEventThatEndsTheBranchMayLieBeforeTheFirstPoint) {
  const SpreadingToy system(25.0 / 6.0, 0.4);
  const TraceOptions options{.target_values = {stop_at_x(1.25)},
                             .stop_events = {{.kind = EventKind::limit_point, .label = "event = limit-point"}}};
  const Branch branch = trace(system, options);
  EXPECT_EQ(branch.end.detail, "event = limit-point");
  EXPECT_NEAR(branch.last().state.lambda, 1.1 - 1.0 / 30.0, 1e-12);
}

// A detector that the program added and that asks for one sense.
TEST(FirstPoints, DetectorsOfOneSenseAreHeardInThatSenseAlone) {
  const SpreadingToy system = gentle();
  for (const double zero : {1.0 + 1e-4, 1.05}) {
    SCOPED_TRACE(zero);
    for (const Crossing sense : {Crossing::rising, Crossing::falling}) {
      TraceOptions options{.target_values = {stop_at_x(1.25)}};
      options.detectors.push_back(
          {.crossing = sense, .value = [zero](const PathPoint& point) { return point.state.x[0] - zero; }});
      const Branch branch = trace(system, options);
      EXPECT_EQ(events_of(branch, EventKind::user).size(), sense == Crossing::rising ? 1U : 0U);
    }
  }
}

TEST(FirstPoints, ANumberOfContactsEndsTheBranchAtTheFirstPoint) {
  const SpreadingToy system = gentle();
  const Branch branch = trace(system, {.target_values = {stop_at_x(1.25)}, .stop_contacts = 2});
  EXPECT_EQ(branch.end.detail, "contacts = 2");
  EXPECT_NEAR(branch.last().state.x[0], 1.2, 1e-10);
}

TEST(FirstPoints, NoMorePointsAreGivenThanAllowed) {
  const SpreadingToy system = gentle();
  for (int most = 2; most < 14; ++most)
    EXPECT_EQ(trace(system, {.max_points = most}).arcs.size(), static_cast<std::size_t>(most));
}

// The second mesh moves the point across the tangent by half its error, forward or back.
TEST(FirstPoints, AMeshThatChangesMovesThePathOverNoValue) {
  for (const double error : {-2e-3, 2e-3}) {
    SCOPED_TRACE(error);
    const RemeshingToy system(error);
    for (const double bound : {1.0 - 5e-4, 1.0 - 1e-9, 1.0 + 1e-9, 1.0 + 5e-4}) {
      SCOPED_TRACE(bound);
      const Branch by_lambda = trace(system, {.target_values = {stop_at_lambda(bound)}});
      EXPECT_EQ(by_lambda.end.reason, EndReason::stop);
      EXPECT_NEAR(by_lambda.last().state.lambda, bound, landed);
      const Branch by_x = trace(system, {.target_values = {stop_at_x(bound)}});
      EXPECT_EQ(by_x.end.reason, EndReason::stop);
      EXPECT_NEAR(by_x.last().state.x[0], bound, landed);
    }
    // A value that was met is not met again where the mesh moves back over it. At the bound itself the path has two
    // points in one place: on the value, and where the mesh has changed.
    for (const double value : {1.0 - 5e-4, 1.0, 1.0 + 5e-4})
      for (const TargetValue& target : {at_lambda(value), at_x(value)}) {
        const Branch branch = trace(system, {.target_values = {target, stop_at_lambda(1.5)}});
        EXPECT_EQ(branch.end.reason, EndReason::stop);
        EXPECT_EQ(points_at(branch, target), value == 1.0 ? 2 : 1) << "value " << value;
        expect_equilibria(system, branch);
      }
  }
}

// The first point of the branch is a change of contacts, too.
TEST(FirstPoints, AContactThatClosesAtTheStartEndsABranchThatIsToEndThere) {
  const auto system = test::stopped_springs(2.0);
  const State touching{.x = Vector{{1.0, 1.5}}, .lambda = 1.0, .active_set = {0}};
  const TargetValue far = stop_at_lambda(2.0);
  const Branch by_number = trace(system, {.target_values = {far}, .stop_contacts = 1}, touching);
  EXPECT_EQ(by_number.end.detail, "contacts = 1");
  EXPECT_EQ(by_number.arcs.size(), 1U);
  const StopEvent closes{.kind = EventKind::contact_closes, .label = "event = contact-closes"};
  const Branch by_event = trace(system, {.target_values = {far}, .stop_events = {closes}}, touching);
  EXPECT_EQ(by_event.end.detail, "event = contact-closes");
  EXPECT_EQ(by_event.arcs.size(), 1U);
}

// Behind the fold the step is tried again on another mesh. Its own fold lies a little before or behind: the one at
// which the step begins stays what it is, and there is no other.
TEST(FirstPoints, AFoldAtWhichAStepIsTriedAgainIsFoundOnce) {
  for (const double error : {-1e-6, -1e-9, 1e-9, 1e-6}) {
    SCOPED_TRACE(error);
    const test::RemeshedFoldToy system(error);
    const State before{.x = Vector{{-0.1}}, .lambda = -0.01};
    // The fold lies near the end of its step: the next one leads from there far behind the obstacle.
    const TraceOptions options{.step = {.first = 0.05, .max = 0.06, .wanted_turn = 2.0, .max_turn = 2.0},
                               .target_values = {stop_at_x(0.4)}};
    const Branch branch = trace(system, options, before);
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    const Event fold = only_event(branch, EventKind::limit_point);
    EXPECT_NEAR(fold.state.x[0], 0.0, 1e-9);
    EXPECT_EQ(fold.unstable_before, 1);
    EXPECT_EQ(fold.unstable_after, 0);
    EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());
    EXPECT_EQ(branch.last().count.unstable, 0);
  }
}

// A step that is tried again from a start with one contact more is as long as before: the attempts must end all the
// same.
TEST(FirstPoints, InsertedContactsThatSeeNothingMakeNoEndlessLoop) {
  const test::BlindToy system;
  const Branch branch = trace(system, {.target_values = {stop_at_lambda(2.0)}});
  EXPECT_EQ(branch.end.reason, EndReason::not_modelled);
  EXPECT_NEAR(branch.last().state.lambda, 1.0, 1e-6);
  EXPECT_GT(system.inserted, 50);
  EXPECT_LT(system.inserted, 5000);
}

}  // namespace arcwall::first_points_test
