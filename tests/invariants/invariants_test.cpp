#include "tests/support/invariants.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "tests/support/models.hpp"
#include "tests/support/toys.hpp"

// The invariants hold on every model at hand, with and without contact, and are seen when they are violated.
namespace arcwall::invariants_test {

namespace {

using test::Branch;
using test::expect_branch_invariants;

const test::LinearContactToy& springs() {
  static const test::LinearContactToy system = test::stopped_springs(2.0);
  return system;
}

const test::SmoothToy& fold() {
  static const test::SmoothToy system = test::fold();
  return system;
}

const TraceOptions& until_two() {
  static const TraceOptions options{.target_values = {test::stop_at_lambda(2.0)}};
  return options;
}

const TraceOptions& short_run() {
  static const TraceOptions options{.max_points = 20};
  return options;
}

Branch pressed() { return trace(springs(), until_two()); }
Branch folded() { return trace(fold(), short_run(), State{.x = test::scalar(1.0), .lambda = -1.0}); }

std::size_t at_event(const Branch& branch, EventKind kind) {
  for (std::size_t i = 0; i < branch.arcs.size(); ++i)
    for (const Event& event : branch.arcs[i].events)
      if (event.kind == kind) return i;
  ADD_FAILURE() << "no such event";
  return 0;
}

// Branches with one thing wrong, static for the macros below.
Branch& broken() {
  static Branch branch;
  return branch;
}

}  // namespace

TEST(Invariants, HoldOnToysUntouched) {
  expect_branch_invariants(springs(), pressed(), until_two());
  expect_branch_invariants(fold(), folded(), short_run());
}

TEST(Invariants, HoldOnFramesOfSeveralMeshes) {
  for (const int elements : {5, 20, 80}) {
    const auto frame = test::lee_frame(elements);
    TraceOptions options;
    options.step.first = 0.1;
    options.max_points = 60;
    expect_branch_invariants(*frame, test::trace(*frame, options), options, {.recount_every = elements > 20 ? 10 : 1});
  }
}

TEST(Invariants, HoldInTheChannelOnSeveralMeshes) {
  for (const int elements : {10, 20, 40}) {
    SCOPED_TRACE(elements);
    const auto model = test::Channel{.elements = elements, .imperfection = test::snapping_imperfection()}.model();
    TraceOptions options;
    options.step.first = 0.05;
    options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(9.0)};
    expect_branch_invariants(model.system(), test::trace(model.system(), options), options);
  }
}

TEST(Invariants, SeeAPointOffThePath) {
  broken() = folded();
  broken().arcs[5].to.state.lambda += 1e-10;
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(fold(), broken(), short_run()), "|F|");
}

TEST(Invariants, SeeAWrongUnstableCount) {
  broken() = folded();
  broken().arcs[5].to.count.unstable = 1;
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(fold(), broken(), short_run()), "unstable");
}

TEST(Invariants, SeeAContactThatPulls) {
  broken() = pressed();
  State& last = broken().arcs.back().to.state;
  last = {.x = Vector{{1.0, 1.25, -0.5}}, .lambda = 0.5, .active_set = {1}};
  broken().arcs = {broken().arcs.back()};
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(springs(), broken(), until_two()), "pulls");
}

TEST(Invariants, SeeALengthThatDecreases) {
  broken() = folded();
  broken().arcs[5].to.arc = broken().arcs[3].to.arc;
  broken().arcs[5].events.clear();
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(fold(), broken(), short_run()), "arc");
}

TEST(Invariants, SeeALimitPointBesideTheLimit) {
  broken() = folded();
  const std::size_t i = at_event(broken(), EventKind::limit_point);
  const double before = broken().arcs[i - 1].to.state.lambda, after = broken().arcs[i + 1].to.state.lambda;
  ASSERT_GT(std::abs(after - before), 1e-6);
  broken().arcs[i].events[0].state.lambda = 0.5 * (before + after);
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(fold(), broken(), short_run()), "lambda");
}

TEST(Invariants, SeeAContactThatDidNotChange) {
  broken() = pressed();
  const std::size_t i = at_event(broken(), EventKind::contact_closes);
  broken().arcs[i].events[0].guards.clear();
  EXPECT_NONFATAL_FAILURE(expect_branch_invariants(springs(), broken(), until_two()), "guards");
}

}  // namespace arcwall::invariants_test
