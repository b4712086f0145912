#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/dense.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Selke & Kikuchi's second example: a pinned column in a channel, pushed from its right end. Expected values are those
// of the extensible elastica (EA = 210) by shooting and quadrature, unless said otherwise.
namespace arcwall::channel_test {

namespace {

using test::trace;

constexpr double half_sine = 0.00176;

double shortening(const test::ContactModel& model, const State& state) {
  return -model.structure().value(state, model.structure().dof(1, Dof::x));
}

double middle(const test::ContactModel& model, const State& state) {
  const MemberMesh& mesh = model.structure().members()[0];
  return model.structure().current(state, mesh.nodes[mesh.nodes.size() / 2]).y();
}

TraceOptions until(double lambda, double step = 0.05) {
  TraceOptions options;
  options.step.first = step;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(lambda)};
  return options;
}

std::vector<Event> contact_events(const test::Branch& branch) {
  std::vector<Event> found = events_of(branch);
  std::erase_if(found, [](const Event& event) { return event.kind == EventKind::start; });
  return found;
}

// P (1 − P/EA) = n² π² EI/L²
double buckling_load(int n) {
  const double euler = n * n * pi * pi * 0.175 / 4.0;
  return 0.5 * 210.0 * (1.0 - std::sqrt(1.0 - 4.0 * euler / 210.0));
}

}  // namespace

// A half sine of 0.00176 touches the upper wall at 0.430656908534 with shortening 0.032101003206.
TEST(Channel, FirstTouchConvergesWithOrderFourToTheElastica) {
  std::vector<double> sizes, loads, ends;
  for (const int elements : {10, 20, 40, 80}) {
    const auto model = test::Channel{.elements = elements, .imperfection = {{.amplitude = half_sine}}}.model();
    TraceOptions options = until(0.5);
    options.stop_contacts = 1;
    const test::Branch branch = trace(model.system(), options);
    const Event touch = only_event(branch, EventKind::contact_closes);
    EXPECT_NEAR(middle(model, touch.state), 0.15, 1e-11);
    sizes.push_back(1.0 / elements);
    loads.push_back(touch.state.lambda - 0.430656908534);
    ends.push_back(shortening(model, touch.state) - 0.032101003206);
  }
  // The finest mesh is off by some 1e-11, where the rounding of the expected values and of K (EI/h³ ε) begins: three
  // meshes for the slope.
  EXPECT_NEAR(test::observed_order({sizes[0], sizes[1], sizes[2]}, {loads[0], loads[1], loads[2]}), 4.0, 0.2);
  EXPECT_NEAR(test::observed_order({sizes[0], sizes[1], sizes[2]}, {ends[0], ends[1], ends[2]}), 4.0, 0.2);
  EXPECT_NEAR(loads[3], loads[2] / 16.0, 1e-11);
  EXPECT_NEAR(ends[3], ends[2] / 16.0, 1e-11);
}

// With the third harmonic the flat part buckles at a limit point: 6.863204701 where contacts slide; contacts at nodes
// shift it by less than 2 %. Past the snap the middle crosses the channel and meets the lower wall near 4.2536.
TEST(Channel, SnapsThroughToTheOtherWall) {
  const auto model = test::Channel{.imperfection = test::snapping_imperfection()}.model();
  const TraceOptions options = until(10.0);
  const test::Branch branch = trace(model.system(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.lambda, 10.0, 1e-12);

  const auto events = contact_events(branch);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].kind, EventKind::contact_closes);
  EXPECT_NEAR(events[0].state.lambda, 0.4307, 1e-3);
  EXPECT_NEAR(middle(model, events[0].state), 0.15, 2e-4);

  const auto greatest = std::max_element(
      events.begin(), events.end(), [](const Event& a, const Event& b) { return a.state.lambda < b.state.lambda; });
  const auto lowest_wall = std::find_if(events.begin(), events.end(), [&](const Event& event) {
    return event.kind == EventKind::contact_closes && model.system().candidate(event.guards[0]).label().wall == "lower";
  });
  ASSERT_NE(lowest_wall, events.end());
  EXPECT_NEAR(lowest_wall->state.lambda, 4.2536, 0.02 * 4.2536);
  // The greatest load before the lower wall is met is the snap.
  double snap = 0.0;
  for (auto event = events.begin(); event != lowest_wall; ++event)
    if (event->kind == EventKind::limit_point || event->kind == EventKind::contact_limit_point)
      snap = std::max(snap, event->state.lambda);
  EXPECT_NEAR(snap, 6.863204701, 0.02 * 6.863204701);
  EXPECT_GE(greatest->state.lambda, snap);
  EXPECT_NEAR(middle(model, branch.last().state), -0.15, 1e-3);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 3});
}

TEST(Channel, AnyStepAndAnyArcLengthMethodFindTheSameEventsSlow) {
  const auto model = test::Channel{.imperfection = test::snapping_imperfection()}.model();
  const auto expected = contact_events(trace(model.system(), until(10.0)));
  for (const double step : {0.005, 0.5}) {
    SCOPED_TRACE(step);
    test::expect_same_events(contact_events(trace(model.system(), until(10.0, step))), expected);
  }
  for (const PathMethod method :
       {PathMethod::riks, PathMethod::normal_plane, PathMethod::cylindrical, PathMethod::pseudo_arclength}) {
    SCOPED_TRACE(static_cast<int>(method));
    TraceOptions options = until(10.0);
    options.method = method;
    test::expect_same_events(contact_events(trace(model.system(), options)), expected);
  }
}

TEST(Channel, UnitsDoNotMatterSlow) {
  const auto in_cm = test::Channel{.imperfection = test::snapping_imperfection()}.model();
  const auto in_m = test::Channel{.imperfection = test::snapping_imperfection(0.01), .cm = 0.01, .kN = 1000.0}.model();
  const auto expected = trace(in_cm.system(), until(10.0)), found = trace(in_m.system(), until(10.0));
  test::expect_same_events(contact_events(found), contact_events(expected), {.relative = 1e-9});
  const auto a = contact_events(expected), b = contact_events(found);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    EXPECT_NEAR(shortening(in_m, b[i].state), 0.01 * shortening(in_cm, a[i].state),
                1e-9 * 0.01 * std::max(1e-3, std::abs(shortening(in_cm, a[i].state))));
}

// Without an imperfection and without walls the column stays straight: u = −λ L/EA. Its buckling loads solve
// P (1 − P/EA) = n² π² EI/L²: 0.432687, 1.74166, 3.96086, 7.18….
TEST(Channel, APerfectColumnStaysStraightAndCountsItsBucklingModes) {
  const auto model = test::Channel{.elements = 20, .walls = false}.model();
  TraceOptions options = until(8.0);
  options.step.first = 0.1;
  const test::Branch branch = trace(model.structure(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.lambda, 8.0, 1e-12);
  for (const Arc& arc : branch.arcs) {
    EXPECT_NEAR(shortening(model, arc.to.state), arc.to.state.lambda * 2.0 / 210.0, 1e-12);
    EXPECT_NEAR(middle(model, arc.to.state), 0.0, 1e-12);
  }
  const auto buckling = events_of(branch, EventKind::branch_point);
  ASSERT_EQ(buckling.size(), 4U);
  for (int n = 1; n <= 4; ++n) {
    // Hermite cubics overestimate the load of a half wave number k by (k h)⁴/720 to first order.
    const Event& event = buckling[static_cast<std::size_t>(n) - 1];
    EXPECT_NEAR(event.state.lambda / buckling_load(n), 1.0, std::pow(n * pi / 20.0, 4) / 600.0);
    EXPECT_EQ(event.unstable_before, n - 1);
    EXPECT_EQ(event.unstable_after, n);
    ASSERT_NE(event.branching, nullptr);
    EXPECT_EQ(event.branching->type, BranchType::pitchfork);
    EXPECT_EQ(event.branching->multiplicity, 1);
  }
  EXPECT_EQ(branch.last().count.unstable, 4);
  EXPECT_TRUE(events_of(branch, EventKind::limit_point).empty());
  expect_branch_invariants(model.structure(), branch, options);
}

// The classic beam's buckling loads are off by h⁴: at 20 elements 1e-6 for the first, more for the higher ones.
TEST(Channel, UnstableCountsOfAPerfectColumnChangeAtTheBucklingLoads) {
  const auto model = test::Channel{.elements = 20, .walls = false}.model();
  for (const int n : {1, 2, 3, 4}) {
    const double P = buckling_load(n);
    for (const double side : {-1.0, 1.0}) {
      State state{.x = Vector::Zero(model.structure().size({})), .lambda = P * (1.0 + side * 1e-3)};
      state = test::solved_at(model.structure(), state, state.lambda, 1);
      EXPECT_EQ(test::dense_unstable_count(model.structure(), state), side < 0.0 ? n - 1 : n);
    }
  }
}

// An imperfect column bends away before the buckling load, however small the imperfection: the path is connected, and
// the straight branch beyond is another. The perfect beam touches at 0.435739888353, the one with 0.00176 earlier by
// 2.888 times that; the curvature between leaves a thousandth of it, the mesh some 1e-9. Traced as long as the contact
// is a point: beyond 1.7 the column lies flat, where node contact has gaps as small as round-off.
TEST(Channel, ASmallImperfectionBendsTheColumnToTheWall) {
  for (const double amplitude : {1e-5, 1e-6, 1e-7}) {
    SCOPED_TRACE(amplitude);
    const auto model = test::Channel{.imperfection = {{.amplitude = amplitude}}}.model();
    const TraceOptions options = until(1.5);
    const test::Branch branch = trace(model.system(), options);
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_NEAR(branch.last().state.lambda, 1.5, 1e-12);
    const auto closes = events_of(branch, EventKind::contact_closes);
    ASSERT_FALSE(closes.empty());
    EXPECT_NEAR(closes[0].state.lambda, 0.435739888353 - 2.888 * amplitude, 5e-9 + 0.005 * amplitude);
    EXPECT_NEAR(middle(model, closes[0].state), 0.15, 1e-11);
    expect_branch_invariants(model.system(), branch, options, {.recount_every = 10});
  }
}

// A billionth is less than the tracer can tell from nothing: whichever way it goes, it arrives.
TEST(Channel, AnImperfectionOfABillionthRunsThrough) {
  const auto model = test::Channel{.imperfection = {{.amplitude = 1e-9}}}.model();
  const TraceOptions options = until(3.0);
  const test::Branch branch = trace(model.system(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  EXPECT_NEAR(branch.last().state.lambda, 3.0, 1e-12);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 10});
}

}  // namespace arcwall::channel_test
