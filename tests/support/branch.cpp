#include "tests/support/branch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"

namespace arcwall::test {

State rest(const System& system) {
  const ActiveSet open = system.open_active_set();
  return {.x = Vector::Zero(system.size(open)), .lambda = 0.0, .active_set = open};
}

Branch trace(const System& system, const TraceOptions& options, const State& start, std::vector<Watch> watched) {
  Tracer tracer(system, start, options, std::move(watched));
  Branch branch{.lambda_scale = tracer.lambda_scale()};
  while (auto arc = tracer.next()) {
    branch.arcs.push_back(std::move(*arc));
    if (branch.arcs.size() > 20'000) tracer.stop({.reason = EndReason::interrupted, .detail = "too long for a test"});
  }
  EXPECT_TRUE(tracer.end().has_value());
  if (tracer.end()) branch.end = *tracer.end();
  return branch;
}

Branch trace(const System& system, const TraceOptions& options, std::vector<Watch> watched) {
  return trace(system, options, rest(system), std::move(watched));
}

std::vector<Event> events_of(const Branch& branch) {
  std::vector<Event> found;
  for (const Arc& arc : branch.arcs) found.insert(found.end(), arc.events.begin(), arc.events.end());
  return found;
}

std::vector<Event> events_of(const Branch& branch, EventKind kind) {
  std::vector<Event> found = events_of(branch);
  std::erase_if(found, [kind](const Event& event) { return event.kind != kind; });
  return found;
}

Event only_event(const Branch& branch, EventKind kind) {
  const std::vector<Event> found = events_of(branch, kind);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? Event{} : found.front();
}

void expect_same_events(const std::vector<Event>& found, const std::vector<Event>& expected, const SameEvents& how) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE("event " + std::to_string(i));
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_EQ(found[i].label, expected[i].label);
    EXPECT_EQ(found[i].guards, expected[i].guards);
    EXPECT_EQ(found[i].unconfirmed, expected[i].unconfirmed);
    EXPECT_EQ(found[i].unstable_before, expected[i].unstable_before);
    EXPECT_EQ(found[i].unstable_after, expected[i].unstable_after);
    const bool turns = expected[i].kind == EventKind::turning_point;
    const double lambda = expected[i].state.lambda, relative = turns ? how.at_displacement_limits : how.relative;
    const double uncertain = found[i].lambda_uncertainty + expected[i].lambda_uncertainty;
    EXPECT_NEAR(found[i].state.lambda, lambda, relative * std::abs(lambda) + uncertain);
  }
}

TargetValue stop_at_lambda(double value) {
  return {.quantity = std::make_shared<ParameterValue>(),
          .value = value,
          .stops = true,
          .label = "lambda = " + round_trip(value)};
}

}  // namespace arcwall::test
