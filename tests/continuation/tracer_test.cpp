#include "continuation/tracer.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/invariants.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::tracer_test {

namespace {

using test::Branch;
using test::events_of;
using test::expect_branch_invariants;
using test::only_event;
using test::stop_at_lambda;
using test::trace;

// The first unknown.
struct First final : Observable {
  double value(const State& s) const override { return s.x[0]; }
  Row gradient(const State& s) const override { return {.dx = Vector::Unit(s.x.size(), 0), .dlambda = 0.0}; }
};

std::shared_ptr<const Observable> x() { return std::make_shared<First>(); }
std::shared_ptr<const Observable> lambda() { return std::make_shared<ParameterValue>(); }

State at(double x, double l) { return {.x = test::scalar(x), .lambda = l}; }

TargetValue stop_at_x(double value) { return {.quantity = x(), .value = value, .stops = true, .label = "x"}; }

constexpr PathMethod arc_length_methods[] = {PathMethod::riks, PathMethod::normal_plane, PathMethod::cylindrical,
                                             PathMethod::spherical, PathMethod::pseudo_arclength};

// A strut that its load pushes towards two stops, u = λ, and that tips aside, v: energy u²/2 − v²/4 − λ u, gaps 1 − u −
// v and 1 + ε − u + v. On the first stop u = 2 λ − 1, v = 2 − 2 λ, p = 1 − λ, stable; at λ = 1 it is let go, ε before
// the second stop. With ε = 0 four ways meet there: off both stops with λ falling, unstable; on the second alone, with
// λ falling; on both with λ rising, p₁ = p₂ = (λ − 1)/2; and back.
test::LinearContactToy strut_between_stops(double epsilon) {
  test::LinearContactToy system;
  system.A = Matrix{{1.0, 0.0}, {0.0, -0.5}};
  system.f = Vector::Unit(2, 0);
  system.G = Matrix{{-1.0, -1.0}, {-1.0, 1.0}};
  system.gap0 = Vector{{1.0, 1.0 + epsilon}};
  return system;
}

// Which stops are closed in the end, from where the strut is on the first one.
Branch of_strut(double epsilon) {
  const State leaning{.x = Vector{{0.0, 1.0, 0.5}}, .lambda = 0.5, .active_set = {1, 0}};
  const TraceOptions options{.target_values = {stop_at_lambda(0.4), stop_at_lambda(2.0)}};
  return trace(strut_between_stops(epsilon), options, leaning);
}

}  // namespace

// x² + λ = 0 from (1, −1): the fold at (0, 0), then x < 0 with one unstable direction.
TEST(Tracer, EveryArcLengthMethodPassesAFoldAndFindsIt) {
  const test::SmoothToy system = test::fold();
  for (const PathMethod method : arc_length_methods) {
    SCOPED_TRACE(static_cast<int>(method));
    const TraceOptions options{.method = method, .target_values = {stop_at_x(-0.8)}};
    const Branch branch = trace(system, options, at(1.0, -1.0));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_NEAR(branch.last().state.x[0], -0.8, 1e-12);
    EXPECT_NEAR(branch.last().state.lambda, -0.64, 1e-12);
    const Event fold = only_event(branch, EventKind::limit_point);
    // λ′ is sure to 1e-12 of a step and x = −λ′/2 to within that; λ = −x².
    EXPECT_NEAR(fold.state.x[0], 0.0, 1e-10);
    EXPECT_NEAR(fold.state.lambda, 0.0, 1e-15);
    EXPECT_EQ(fold.unstable_before, 0);
    EXPECT_EQ(fold.unstable_after, 1);
    expect_branch_invariants(system, branch, options);
  }
}

TEST(Tracer, LoadControlStopsAtAFoldAndSaysWhy) {
  const test::SmoothToy system = test::fold();
  const TraceOptions options{.method = PathMethod::load, .target_values = {stop_at_x(-0.8)}};
  const Branch branch = trace(system, options, at(1.0, -1.0));
  EXPECT_EQ(branch.end.reason, EndReason::control_turns);
  EXPECT_LE(branch.last().state.lambda, 0.0);
  EXPECT_GE(branch.last().state.lambda, -1e-4);
  EXPECT_GE(branch.last().state.x[0], 0.0);
}

TEST(Tracer, DisplacementControlPassesALimitOfLambdaButNoLimitOfItsDisplacement) {
  const TraceOptions options{.method = PathMethod::displacement, .control = x(), .target_values = {stop_at_x(-0.8)}};
  const test::SmoothToy fold = test::fold();
  const Branch passed = trace(fold, options, at(1.0, -1.0));
  EXPECT_EQ(passed.end.reason, EndReason::stop);
  EXPECT_EQ(events_of(passed, EventKind::limit_point).size(), 1U);
  expect_branch_invariants(fold, passed, options);

  // On the circle x turns at (1, 0), where λ rises from −√½.
  const Branch turned = trace(test::unit_circle(), options, at(std::sqrt(0.5), -std::sqrt(0.5)));
  EXPECT_EQ(turned.end.reason, EndReason::control_turns);
  EXPECT_NEAR(turned.last().state.x[0], 1.0, 1e-4);
}

// x³ − a x + λ: folds at λ = ±(2/3) a √(a/3), x = ∓√(a/3) on the way from negative x … to positive.
TEST(Tracer, FindsBothFoldsOfACuspHoweverNearTheyAre) {
  for (const double a : {1.0, 0.3, 0.03, 0.003}) {
    SCOPED_TRACE(a);
    const test::SmoothToy system = test::cusp(a);
    const double x0 = 1.3;
    const TraceOptions options{.target_values = {stop_at_x(-1.3)}};
    const Branch branch = trace(system, options, at(x0, a * x0 - x0 * x0 * x0));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    const auto folds = events_of(branch, EventKind::limit_point);
    ASSERT_EQ(folds.size(), 2U);
    const double expected = 2.0 / 3.0 * a * std::sqrt(a / 3.0);
    EXPECT_NEAR(folds[0].state.lambda, expected, 1e-12);
    EXPECT_NEAR(folds[1].state.lambda, -expected, 1e-12);
    EXPECT_EQ(folds[0].unstable_after, 1);
    EXPECT_EQ(folds[1].unstable_after, 0);
    expect_branch_invariants(system, branch, options);
  }
}

// λ = b (x − c tanh x/d): two straight branches side by side, 2 c b/√(1 + b²) apart, and between them a steep one from
// the fold at x = −d arcosh √(c/d) to that at +d arcosh √(c/d). A step that is longer than the way between the branches
// ends on the second with the tangent of the first.
TEST(Tracer, DoesNotStepOverTwoFoldsOntoTheBranchBeside) {
  constexpr double b = 5.0, c = 0.025, d = 0.005;
  test::SmoothToy system;
  system.F = [](const Vector& x, double l) { return test::scalar(b * (x[0] - c * std::tanh(x[0] / d)) - l); };
  system.K = [](const Vector& x, double) {
    return test::scalar_matrix(b * (1.0 - c / d / std::pow(std::cosh(x[0] / d), 2)));
  };
  system.F_lambda = [](const Vector&, double) { return test::scalar(-1.0); };
  const double fold = d * std::acosh(std::sqrt(c / d)), expected = b * (c * std::tanh(fold / d) - fold);
  for (int i = 0; i < 20; ++i) {
    const double from = -1.0 - 0.01 * i;
    SCOPED_TRACE(from);
    const TraceOptions options{.step = {.first = 0.1}, .target_values = {stop_at_lambda(1.0)}, .lambda_scale = 1.0};
    const Branch branch = trace(system, options, at(from / b - c, from));
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    const auto folds = events_of(branch, EventKind::limit_point);
    ASSERT_EQ(folds.size(), 2U);
    EXPECT_NEAR(folds[0].state.lambda, expected, 1e-12);
    EXPECT_NEAR(folds[1].state.lambda, -expected, 1e-12);
  }
}

TEST(Tracer, AnInflectionWithALevelTangentIsASuspectedLimitPointAtMost) {
  const test::SmoothToy system = test::cusp(0.0);
  const Branch branch = trace(system, {.target_values = {stop_at_x(-1.0)}}, at(1.0, -1.0));
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  const Event event = only_event(branch, EventKind::limit_point);
  EXPECT_TRUE(event.unconfirmed);
  EXPECT_EQ(event.unstable_before, event.unstable_after);
}

TEST(Tracer, LandmarksAreLandedOnExactly) {
  const test::SmoothToy system = test::spring(4.0);
  const TraceOptions options{
      .target_values = {{.quantity = lambda(), .value = 0.37},
                        {.quantity = x(), .value = 0.11},
                        {.quantity = lambda(), .value = 1.0, .stops = true, .label = "lambda = 1"}}};
  const Branch branch = trace(system, options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_EQ(branch.end.detail, "lambda = 1");
  EXPECT_NEAR(branch.last().state.lambda, 1.0, 1e-14);
  const auto passes = [&](double l) {
    return std::count_if(branch.arcs.begin(), branch.arcs.end(),
                         [l](const Arc& arc) { return std::abs(arc.to.state.lambda - l) <= 1e-14; });
  };
  EXPECT_EQ(passes(0.37), 1);
  EXPECT_EQ(passes(0.44), 1);  // x = λ/4
  expect_branch_invariants(system, branch, options);
}

TEST(Tracer, ALandmarkAtTheStartCountsOnlyWhenItIsMetAgain) {
  const TraceOptions options{.target_values = {stop_at_lambda(-1.0)}};
  const Branch branch = trace(test::fold(), options, at(1.0, -1.0));
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.x[0], -1.0, 1e-10);
}

TEST(Tracer, TheSignOfTheFirstStepIsTheDirection) {
  const TraceOptions options{.step = {.first = -0.02}, .target_values = {stop_at_lambda(-1.0), stop_at_lambda(1.0)}};
  EXPECT_NEAR(trace(test::spring(4.0), options).last().state.lambda, -1.0, 1e-14);
}

TEST(Tracer, TheFirstStepChangesLambdaByAsMuchAsAsked) {
  const TraceOptions options{.step = {.first = 0.013}, .target_values = {stop_at_lambda(1.0)}};
  EXPECT_NEAR(trace(test::spring(4.0), options).arcs.at(1).to.state.lambda, 0.013, 1e-14);
}

TEST(Tracer, AClosedLoopEndsWhereItBegan) {
  const test::SmoothToy system = test::unit_circle();
  const double half = std::sqrt(0.5);
  for (const PathMethod method : {PathMethod::spherical, PathMethod::pseudo_arclength}) {
    const TraceOptions options{.method = method, .max_points = 500};
    const Branch branch = trace(system, options, at(half, half));
    EXPECT_EQ(branch.end.reason, EndReason::closed_loop);
    const auto folds = events_of(branch, EventKind::limit_point);
    ASSERT_EQ(folds.size(), 2U);
    EXPECT_NEAR(folds[0].state.lambda, 1.0, 1e-12);
    EXPECT_NEAR(folds[1].state.lambda, -1.0, 1e-12);
    expect_branch_invariants(system, branch, options);
    // Chords of steps up to 0.2 add up to less than the circumference, by a part of 0.2²/24.
    EXPECT_NEAR(branch.last().arc, 2.0 * pi, 0.3);
  }
}

TEST(Tracer, EndsAfterAsManyPointsAsAllowed) {
  const Branch branch = trace(test::spring(1.0), {.max_points = 7});
  EXPECT_EQ(branch.end.reason, EndReason::max_points);
  EXPECT_EQ(branch.arcs.size(), 7U);
}

TEST(Tracer, CanBeStoppedFromOutside) {
  const test::SmoothToy system = test::spring(1.0);
  Tracer tracer(system, at(0.0, 0.0), {});
  ASSERT_TRUE(tracer.next().has_value());
  tracer.stop({.reason = EndReason::interrupted, .detail = "enough"});
  EXPECT_FALSE(tracer.next().has_value());
  EXPECT_EQ(tracer.end()->reason, EndReason::interrupted);
}

TEST(Tracer, TurningPointsOfWatchedMonitorsAreEvents) {
  const test::SmoothToy system = test::unit_circle();
  const TraceOptions options{.max_points = 500};
  const Branch branch = trace(system, options, at(std::sqrt(0.5), std::sqrt(0.5)), {{.quantity = x(), .label = "x"}});
  const auto turns = events_of(branch, EventKind::turning_point);
  ASSERT_EQ(turns.size(), 2U);
  for (const Event& turn : turns) {
    EXPECT_EQ(turn.label, "x");
    EXPECT_NEAR(std::abs(turn.state.x[0]), 1.0, 1e-12);
    EXPECT_NEAR(turn.state.lambda, 0.0, 1e-9);
  }
}

TEST(Tracer, DetectReportsAtTheEndOfTheStepAndNoneNotAtAll) {
  const test::SmoothToy system = test::fold();
  const Branch detected =
      trace(system, {.target_values = {stop_at_x(-0.8)}, .events = EventSearch::detect}, at(1.0, -1.0));
  const Event fold = only_event(detected, EventKind::limit_point);
  EXPECT_LT(fold.state.x[0], 0.0);
  EXPECT_GT(fold.state.x[0], -0.25);
  EXPECT_GT(fold.lambda_uncertainty, 1e-6);
  EXPECT_GE(fold.lambda_uncertainty, -fold.state.lambda) << "the fold at λ = 0 lies within";
  const Branch silent = trace(system, {.target_values = {stop_at_x(-0.8)}, .events = EventSearch::none}, at(1.0, -1.0));
  EXPECT_TRUE(events_of(silent, EventKind::limit_point).empty());
  EXPECT_NEAR(silent.last().state.x[0], -0.8, 1e-12);
}

TEST(Tracer, TheFirstArcHasLengthZeroAndTheStartEvent) {
  const Branch branch = trace(test::spring(1.0), {.max_points = 3});
  EXPECT_EQ(branch.arcs[0].to.arc, 0.0);
  ASSERT_EQ(branch.arcs[0].events.size(), 1U);
  EXPECT_EQ(branch.arcs[0].events[0].kind, EventKind::start);
}

// x = √λ … as a system that is not defined for λ > 1: F = x − √(1 − λ).
TEST(Tracer, EndsWhereNumbersAreNoLongerFinite) {
  test::SmoothToy system;
  system.F = [](const Vector& u, double l) { return test::scalar(u[0] - (l > 1.0 ? std::nan("") : l)); };
  system.K = [](const Vector&, double) { return test::scalar_matrix(1.0); };
  system.F_lambda = [](const Vector&, double) { return test::scalar(-1.0); };
  const Branch branch = trace(system, {});
  EXPECT_EQ(branch.end.reason, EndReason::not_finite);
  EXPECT_NEAR(branch.last().state.lambda, 1.0, 1e-6);
  EXPECT_LE(branch.last().state.lambda, 1.0);
}

TEST(Tracer, EndsAtTheStartIfNothingMovesThere) {
  test::SmoothToy system = test::spring(1.0);
  system.K = [](const Vector&, double) { return test::scalar_matrix(0.0); };
  system.F_lambda = [](const Vector&, double) { return test::scalar(0.0); };
  Tracer tracer(system, at(0.0, 0.0), {});
  EXPECT_FALSE(tracer.next().has_value());
  EXPECT_EQ(tracer.end()->reason, EndReason::singular);
}

// --- contact -------------------------------------------------------------------------------------------------------

TEST(Tracer, ClosesAContactWhereItTouchesAndGoesOn) {
  const auto system = test::stopped_springs(2.0);
  const TraceOptions options{.target_values = {stop_at_lambda(2.0)}};
  const Branch branch = trace(system, options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  const Event closes = only_event(branch, EventKind::contact_closes);
  EXPECT_NEAR(closes.state.lambda, 1.0, 1e-12);
  EXPECT_EQ(closes.guards, std::vector<Index>{0});
  EXPECT_EQ(closes.unstable_before, 0);
  EXPECT_EQ(closes.unstable_after, 0);
  ASSERT_EQ(branch.last().state.x.size(), 3);
  EXPECT_NEAR(branch.last().state.x[1], 2.0, 1e-12);
  EXPECT_NEAR(branch.last().state.x[2], 1.0, 1e-12);  // p = λ − 1
  expect_branch_invariants(system, branch, options);
}

TEST(Tracer, OpensAContactWhoseForceVanishes) {
  const auto system = test::stopped_springs(2.0);
  const State pressed{.x = Vector{{1.0, 2.0, 1.0}}, .lambda = 2.0, .active_set = {1}};
  const TraceOptions options{.step = {.first = -0.02}, .target_values = {stop_at_lambda(0.5)}};
  const Branch branch = trace(system, options, pressed);
  const Event opens = only_event(branch, EventKind::contact_opens);
  EXPECT_NEAR(opens.state.lambda, 1.0, 1e-12);
  EXPECT_EQ(branch.last().state.x.size(), 2);
  EXPECT_NEAR(branch.last().state.x[0], 0.5, 1e-12);
  expect_branch_invariants(system, branch, options);
}

// The first step, of 0.1 in λ, ends within some units of the last digit of the corner at λ = 1, on either side. Between
// such a point and the corner differences are round-off, and must not look like something that happens there.
TEST(Tracer, AStepThatEndsWithinRoundOffOfACornerIsFollowedByTheCorner) {
  for (const double k : {0.7, 2.0, 3.0}) {
    const test::LinearContactToy system = test::stopped_springs(k);
    for (int i = -20; i <= 20; ++i) {
      SCOPED_TRACE(i);
      const double begin = 1.1 + i * std::numeric_limits<double>::epsilon();
      const State start{
          .x = Vector{{1.0, 1.0 + begin / k, begin - 1.0}}, .lambda = begin, .active_set = ActiveSet(1, 1)};
      const Branch branch = trace(system, {.step = {.first = -0.1}, .target_values = {stop_at_lambda(0.5)}}, start);
      EXPECT_EQ(branch.end.reason, EndReason::stop);
      EXPECT_NEAR(only_event(branch, EventKind::contact_opens).state.lambda, 1.0, 1e-12);
    }
  }
}

// As where a mesh is drawn anew just behind a corner. A second corner at λ = 1 would have two ways, the one forward and
// the one that the path has come along.
TEST(Tracer, AForceThatIsNotZeroByTheErrorOfAMeshAndGrowsIsNoSecondCorner) {
  const auto system = test::stopped_springs(2.0);
  const State touched{.x = Vector{{1.0, 1.5 - 2.5e-9, -5e-9}}, .lambda = 1.0 - 5e-9, .active_set = {1}};
  const Branch branch = trace(system, {.target_values = {stop_at_lambda(2.0)}}, touched);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_EQ(events_of(branch).size(), 1u);  // the start
  EXPECT_EQ(branch.last().state.active_set, ActiveSet{1});
}

// A = −1, g = x: from (x, λ) = (1, −1) along x = −λ, which is unstable; at λ = 0 the contact closes and λ turns back
// with p = −λ, which is stable.
TEST(Tracer, AContactThatMakesLambdaTurnIsALimitPoint) {
  test::LinearContactToy system;
  system.A = -Matrix::Identity(1, 1);
  system.f = Vector::Ones(1);
  system.G = Matrix::Identity(1, 1);
  system.gap0 = Vector::Zero(1);
  const TraceOptions options{.target_values = {stop_at_lambda(-2.0)}};
  const Branch branch = trace(system, options, {.x = test::scalar(1.0), .lambda = -1.0, .active_set = {0}});
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(only_event(branch, EventKind::contact_closes).state.lambda, 0.0, 1e-12);
  const Event limit = only_event(branch, EventKind::contact_limit_point);
  EXPECT_NEAR(limit.state.lambda, 0.0, 1e-12);
  EXPECT_EQ(limit.unstable_before, 1);
  EXPECT_EQ(limit.unstable_after, 0);
  EXPECT_TRUE(events_of(branch, EventKind::limit_point).empty());
  expect_branch_invariants(system, branch, options);
}

// A contact that is not closed to the last digit where another is let go, but for less than any mesh is sure of, closes
// there: else only the unstable way is left.
TEST(Tracer, AContactThatMissesACornerByTheErrorOfAMeshBelongsToIt) {
  for (const double epsilon : {0.0, 1e-13, 1e-11, 1e-9, 5e-7}) {
    SCOPED_TRACE(epsilon);
    const Branch branch = of_strut(epsilon);
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_EQ(branch.last().state.active_set, (ActiveSet{1, 1}));
    EXPECT_NEAR(branch.last().state.lambda, 2.0, 1e-12);
    EXPECT_EQ(branch.last().count.unstable, 0);
    EXPECT_NEAR(branch.last().state.x[2] + branch.last().state.x[3], 1.0, 1e-6);  // λ − 1
    EXPECT_EQ(only_event(branch, EventKind::contact_closes).guards, std::vector<Index>{1});
    EXPECT_TRUE(events_of(branch, EventKind::contact_opens).empty());
    EXPECT_NEAR(only_event(branch, EventKind::contact_closes).state.lambda, 1.0, 2.0 * epsilon + 1e-12);
  }
}

// The step log names the strategy of the one step that used it.
TEST(Tracer, LogsThatContactsChangedWithinTheMeshError) {
  const auto strategies_of = [](double epsilon) {
    std::vector<Strategy> used;
    TraceOptions options{.target_values = {stop_at_lambda(0.4), stop_at_lambda(2.0)}};
    options.ledger = [&](const StepAttempt& attempt) {
      used.insert(used.end(), attempt.strategies.begin(), attempt.strategies.end());
    };
    trace(strut_between_stops(epsilon), options, {.x = Vector{{0.0, 1.0, 0.5}}, .lambda = 0.5, .active_set = {1, 0}});
    return used;
  };
  EXPECT_EQ(strategies_of(1e-9), std::vector{Strategy::nearly_degenerate});
  EXPECT_TRUE(strategies_of(1e-3).empty());
}

// What is a gap on any mesh is none of the corner's: the strut falls back, unstable.
TEST(Tracer, AContactThatIsOpenWhereAnotherIsLetGoIsNoneOfTheCorner) {
  const Branch branch = of_strut(1e-3);
  EXPECT_EQ(branch.last().state.active_set, (ActiveSet{0, 0}));
  EXPECT_NEAR(branch.last().state.lambda, 0.4, 1e-12);
  EXPECT_EQ(branch.last().count.unstable, 1);
}

TEST(Tracer, StartsOnAClosedContactWithoutForce) {
  const auto system = test::stopped_springs(2.0);
  const State touching{.x = Vector{{1.0, 1.5}}, .lambda = 1.0, .active_set = {0}};
  const TraceOptions options{.target_values = {stop_at_lambda(2.0), stop_at_lambda(0.0)}};
  const Branch branch = trace(system, options, touching);
  EXPECT_NEAR(branch.last().state.lambda, 2.0, 1e-12);
  EXPECT_EQ(branch.last().state.active_set, ActiveSet{1});
}

TEST(Tracer, EndsAtACornerThatNoRayLeaves) {
  test::LinearContactToy system;  // the rate problem of Corner.ThereMayBeNoRay
  system.A = Matrix{{-1.0, -2.0}, {-2.0, -1.0}}.inverse();
  system.f = system.A * Vector{{1.0, -1.0}};
  system.G = Matrix::Identity(2, 2);
  system.gap0 = Vector::Zero(2);
  Tracer tracer(system, {.x = Vector::Zero(2), .lambda = 0.0, .active_set = {0, 0}}, {});
  while (tracer.next()) {
  }
  EXPECT_EQ(tracer.end()->reason, EndReason::no_continuation);
}

TEST(Tracer, ANumberOfClosedContactsEndsTheBranch) {
  const auto system = test::stopped_springs(2.0);
  const Branch branch = trace(system, {.stop_contacts = 1});
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.lambda, 1.0, 1e-12);
}

TEST(Tracer, AnEventOfAChosenKindEndsTheBranch) {
  const auto system = test::fold();  // λ = −x²
  const State start{.x = test::scalar(-1.0), .lambda = -1.0};
  const TraceOptions options{.target_values = {stop_at_lambda(-2.0)},
                             .stop_events = {{.kind = EventKind::limit_point, .label = "event = limit-point"}}};
  const Branch branch = trace(system, options, start);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_EQ(branch.end.detail, "event = limit-point");
  EXPECT_NEAR(branch.last().state.lambda, 0.0, 1e-12);
}

TEST(Tracer, AWallThatEndsEndsTheBranch) {
  struct Ending final : test::LinearContactToy {
    Ending() : LinearContactToy(test::stopped_springs(2.0)) {}
    StepVerdict check(const CheckedStep& step) const override {
      if (step.located || !step.to.active_set[0] || step.to.lambda <= 1.5) return {};
      return {.fault = StepVerdict::Fault::wall_left, .place = "the post at 0.5"};
    }
  };
  const Ending system;
  const Branch branch = trace(system, {.target_values = {stop_at_lambda(2.0)}});
  EXPECT_EQ(branch.end.reason, EndReason::wall_end);
  EXPECT_EQ(branch.end.detail, "a closed contact reached the end of its wall: the post at 0.5");
  EXPECT_NEAR(branch.last().state.lambda, 1.5, 1e-6);
  EXPECT_LE(branch.last().state.lambda, 1.5);
}

TEST(Tracer, TheSameEventsAreFoundWithAnyStep) {
  const auto system = test::stopped_springs(2.0);
  for (const double step : {0.003, 0.03, 0.3, 3.0})
    for (const PathMethod method : arc_length_methods) {
      const TraceOptions options{.method = method, .step = {.first = step}, .target_values = {stop_at_lambda(2.0)}};
      const Branch branch = trace(system, options);
      EXPECT_EQ(events_of(branch).size(), 2U);  // start, contact
      EXPECT_NEAR(only_event(branch, EventKind::contact_closes).state.lambda, 1.0, 1e-12);
    }
}

}  // namespace arcwall::tracer_test
