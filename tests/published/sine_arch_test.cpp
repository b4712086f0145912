#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/explore.hpp"
#include "tests/support/functions.hpp"
#include "tests/support/invariants.hpp"

// The shallow arch of Fung & Kaplan (1952) in its modes: closed forms, see tests/support/functions.hpp.
namespace arcwall::sine_arch_test {

namespace {

using test::Graph;

TraceOptions to_load(double R) {
  TraceOptions options;
  options.step.first = 0.1;
  options.target_values = {test::stop_at_lambda(R)};
  return options;
}

double limit_load(double e, double sign) { return e + sign * 2.0 * std::pow((e * e - 1.0) / 3.0, 1.5); }
double branch_load(double e, int n, double sign) { return e + sign * (n * n - 1) * std::sqrt(e * e - n * n); }

struct Expected {
  EventKind kind;
  double load;
  Index before, after;
};

void expect_events(const test::Branch& branch, const std::vector<Expected>& expected) {
  std::vector<Event> found = events_of(branch);
  std::erase_if(found, [](const Event& event) { return event.kind == EventKind::start; });
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].state.lambda, expected[i].load, 1e-9 * std::abs(expected[i].load));
    EXPECT_EQ(found[i].unstable_before, expected[i].before);
    EXPECT_EQ(found[i].unstable_after, expected[i].after);
  }
}

}  // namespace

// e² > 11/2: it sways before its limit point. Else the branch point follows.
TEST(SineArch, SwaysBeforeItsLimitPointIfItIsHighEnough) {
  using enum EventKind;
  const auto high = test::sine_arch(3.0, 2), low = test::sine_arch(2.2, 2);
  const TraceOptions to_20 = to_load(20.0), to_10 = to_load(10.0);
  const test::Branch first = test::trace(high, to_20), second = test::trace(low, to_10);
  expect_events(first, {{branch_point, branch_load(3.0, 2, 1.0), 0, 1},
                        {limit_point, limit_load(3.0, 1.0), 1, 2},
                        {limit_point, limit_load(3.0, -1.0), 2, 1},
                        {branch_point, branch_load(3.0, 2, -1.0), 1, 0}});
  expect_events(second, {{limit_point, limit_load(2.2, 1.0), 0, 1},
                         {branch_point, branch_load(2.2, 2, 1.0), 1, 2},
                         {branch_point, branch_load(2.2, 2, -1.0), 2, 1},
                         {limit_point, limit_load(2.2, -1.0), 1, 0}});
  expect_branch_invariants(high, first, to_20);
  expect_branch_invariants(low, second, to_10);
}

TEST(SineArch, TheSwayBranchIsStraightAndJoinsBothBranchPoints) {
  const double e = 3.0;
  const auto arch = test::sine_arch(e, 2);
  const Graph graph = test::explore(arch, to_load(20.0), {.policy = BranchPolicy::all});
  ASSERT_EQ(graph.records.size(), 2U);
  EXPECT_TRUE(graph.records[1].mirror_image);
  EXPECT_EQ(graph.branches[1].end.reason, EndReason::reached_branch);
  for (const Arc& arc : graph.branches[1].arcs) {
    const double b1 = arc.to.state.x[0] + e, b2 = arc.to.state.x[1];
    EXPECT_NEAR(arc.to.state.lambda, e + 3.0 * b1, 1e-8);
    EXPECT_NEAR(4.0 * b2 * b2, e * e - 4.0 - b1 * b1, 1e-8);
  }
}

// e = 5: three branches in 2, 3 and 4 half waves leave the first one before its limit point and come back behind it.
TEST(SineArch, AHighArchHasABranchForEachMode) {
  using enum EventKind;
  const double e = 5.0;
  const auto arch = test::sine_arch(e, 4);
  const Graph graph = test::explore(arch, to_load(60.0), {.policy = BranchPolicy::all, .depth = 1});
  expect_events(graph.branches[0], {{branch_point, branch_load(e, 2, 1.0), 0, 1},
                                    {branch_point, branch_load(e, 3, 1.0), 1, 2},
                                    {branch_point, branch_load(e, 4, 1.0), 2, 3},
                                    {limit_point, limit_load(e, 1.0), 3, 4},
                                    {limit_point, limit_load(e, -1.0), 4, 3},
                                    {branch_point, branch_load(e, 4, -1.0), 3, 2},
                                    {branch_point, branch_load(e, 3, -1.0), 2, 1},
                                    {branch_point, branch_load(e, 2, -1.0), 1, 0}});
  ASSERT_EQ(graph.records.size(), 4U);
  for (const int n : {2, 3, 4}) {
    SCOPED_TRACE(n);
    const test::Branch& branch = graph.branches[static_cast<std::size_t>(n - 1)];
    EXPECT_EQ(branch.end.reason, EndReason::reached_branch);
    for (const Arc& arc : branch.arcs)
      EXPECT_NEAR(arc.to.state.lambda, e + (n * n - 1) * (arc.to.state.x[0] + e), 1e-7);
  }
}

}  // namespace arcwall::sine_arch_test
