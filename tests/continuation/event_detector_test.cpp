#include "continuation/events/event_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/toys.hpp"

// Detectors that a program adds, on x = λ and on F = x² + λ, where x falls from 1 to −1 and λ turns at 0.
namespace arcwall::event_detector_test {

namespace {

using test::Branch;

EventDetector passes(double x, Crossing crossing = Crossing::any) {
  return {.label = "x", .crossing = crossing, .value = [x](const PathPoint& point) { return point.state.x[0] - x; }};
}

Branch traced(const System& system, State start, std::vector<EventDetector> detectors, double until) {
  TraceOptions options;
  options.detectors = std::move(detectors);
  options.target_values = {test::stop_at_lambda(until)};
  return test::trace(system, options, start);
}

Branch along_line(std::vector<EventDetector> detectors) {
  return traced(test::spring(1.0), {.x = test::scalar(0.0), .lambda = 0.0}, std::move(detectors), 1.0);
}

Branch round_the_fold(std::vector<EventDetector> detectors) {
  return traced(test::fold(), {.x = test::scalar(1.0), .lambda = -1.0}, std::move(detectors), -1.0);
}

}  // namespace

TEST(EventDetector, IsAValueThatAProgramAdds) {
  const test::SmoothToy system = test::spring(1.0);
  const State start{.x = Vector::Zero(1), .lambda = 0.0};
  std::vector<double> found;
  TraceOptions options;
  options.target_values = {{.quantity = std::make_shared<ParameterValue>(), .value = 1.0, .stops = true}};
  const auto past_half = [](const PathPoint& point) { return point.state.x[0] - 0.5; };
  options.detectors.push_back({.label = "halfway", .crossing = Crossing::rising, .value = past_half});
  Tracer tracer(system, start, options);
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events)
      if (event.kind == EventKind::user && event.label == "halfway") found.push_back(event.state.lambda);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0], 0.5, 1e-10);
}

TEST(EventDetector, CountsOnlyInItsDirection) {
  EXPECT_EQ(events_of(along_line({passes(0.37, Crossing::any)}), EventKind::user).size(), 1U);
  EXPECT_EQ(events_of(along_line({passes(0.37, Crossing::rising)}), EventKind::user).size(), 1U);
  EXPECT_TRUE(events_of(along_line({passes(0.37, Crossing::falling)}), EventKind::user).empty());
  EXPECT_EQ(events_of(round_the_fold({passes(0.37, Crossing::falling)}), EventKind::user).size(), 1U);
  EXPECT_TRUE(events_of(round_the_fold({passes(0.37, Crossing::rising)}), EventKind::user).empty());
}

TEST(EventDetector, CarriesItsKindAndLabelAndStopsNothing) {
  EventDetector own = passes(0.25);
  own.kind = EventKind::turning_point;
  own.label = "mine";
  const Branch branch = along_line({own, passes(0.75)});
  const Event event = only_event(branch, EventKind::turning_point);
  EXPECT_EQ(event.label, "mine");
  EXPECT_NEAR(event.state.x[0], 0.25, 1e-10);
  EXPECT_NEAR(only_event(branch, EventKind::user).state.x[0], 0.75, 1e-10);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
}

// A zero where two arcs meet counts once: 0.3 is the end of a step, 0.02 + 0.04 + 0.08 +
// 0.16.
TEST(EventDetector, TriggersOnceWhereAStepEndsOnItsZero) {
  const Branch branch = along_line({passes(0.3)});
  EXPECT_NEAR(only_event(branch, EventKind::user).state.x[0], 0.3, 1e-7);
}

TEST(EventDetector, IgnoresAZeroAtTheStart) {
  EXPECT_TRUE(events_of(along_line({passes(0.0)}), EventKind::user).empty());
  EXPECT_TRUE(events_of(round_the_fold({passes(1.0)}), EventKind::user).empty());
}

TEST(EventDetector, SeesAZeroOnALimitPointBesideIt) {
  const Branch branch = round_the_fold({passes(0.0)});
  EXPECT_EQ(events_of(branch, EventKind::limit_point).size(), 1U);
  EXPECT_NEAR(only_event(branch, EventKind::user).state.x[0], 0.0, 1e-7);
}

// 1e-3 of round-off in a value hide its zero in as much of the path: none of the many within is found to more digits.
TEST(EventDetector, SaysHowFarRoundoffHidesItsZero) {
  EventDetector rough = passes(0.37);
  rough.value = [](const PathPoint& point) {
    const double x = point.state.x[0];
    return x - 0.37 + 1e-3 * std::sin(1e11 * x);
  };
  const Event event = only_event(along_line({rough}), EventKind::user);
  EXPECT_NEAR(event.state.x[0], 0.37, 2e-3);
  EXPECT_GE(event.lambda_uncertainty, 1e-6);
  EXPECT_LE(event.lambda_uncertainty, 2e-3);
}

// A value that jumps over zero has no zero. The event is where it jumps, however near zero it is on either side: within
// what it says, which sixty points make narrow.
TEST(EventDetector, SaysWhereItsValueJumps) {
  for (const double before : {1.0, 1e-2, 1e-5})
    for (const double behind : {1.0, 1e-2, 1e-5})
      for (const double slope : {-2.0, 0.0, 2.0})
        for (const double at : {0.15, 0.37, 0.5, 0.93}) {
          SCOPED_TRACE(testing::Message()
                       << "from " << before << " to " << -behind << ", slope " << slope << ", at " << at);
          EventDetector jump = passes(at);
          jump.value = [=](const PathPoint& point) {
            const double x = point.state.x[0] - at;
            return (x < 0.0 ? before : -behind) * std::exp(slope * std::abs(x));
          };
          const Event event = only_event(along_line({jump}), EventKind::user);
          EXPECT_NEAR(event.state.x[0], at, std::max(event.lambda_uncertainty, 1e-12));
          EXPECT_LE(event.lambda_uncertainty, 1e-6);
        }
}

}  // namespace arcwall::event_detector_test
