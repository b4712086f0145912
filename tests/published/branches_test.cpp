#include <gtest/gtest.h>

#include <cmath>

#include "elements/member_point.hpp"
#include "tests/support/explore.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// The branches of the perfect column of Selke & Kikuchi's second example [kN, cm], free and between walls: P (1 − P/EA)
// = n² P_E, P_E = π² EI/L², at its branch points; what lies behind them by shooting with the extensible elastica.
namespace arcwall::branches_test {

namespace {

constexpr double EA = 210.0, euler = pi * pi * 0.175 / 4.0;

double buckling_load(int n) { return 0.5 * EA * (1.0 - std::sqrt(1.0 - 4.0 * n * n * euler / EA)); }

TraceOptions until(double lambda) {
  TraceOptions trace;
  trace.step.first = 0.05;
  trace.target_values = {test::stop_at_lambda(lambda)};
  return trace;
}

std::shared_ptr<const Observable> middle_of(const test::ContactModel& model) {
  const MemberMesh& mesh = model.structure().members()[0];
  return std::make_shared<MemberObservable>(model.structure(), mesh, (mesh.nodes.size() - 1) / 2,
                                            MemberObservable::Component::z);
}

}  // namespace

// Without walls: four pitchforks up to λ = 8, from which branches in n half waves rise. The n-th has lost n − 1
// directions, as its predecessors; each ends at the load at which the first of them does.
TEST(FreeColumn, AllFourBranchesAreFoundWithTheirCounts) {
  const auto model = test::Channel{.elements = 40, .walls = false}.model();
  const TraceOptions trace = until(8.0);
  const test::Graph graph = test::explore(model.structure(), trace, {.policy = BranchPolicy::all, .depth = 1});
  const auto points = events_of(graph.branches[0], EventKind::branch_point);
  ASSERT_EQ(points.size(), 4U);
  ASSERT_EQ(graph.records.size(), 5U);
  for (int n = 1; n <= 4; ++n) {
    SCOPED_TRACE(n);
    const Event& event = points[static_cast<std::size_t>(n - 1)];
    // The element overestimates the load of a half wave number k by (k h)⁴/720 to first order.
    EXPECT_NEAR(event.state.lambda / buckling_load(n), 1.0, std::pow(n * pi / 40.0, 4) / 600.0);
    EXPECT_EQ(event.unstable_before, n - 1);
    EXPECT_EQ(event.unstable_after, n);
    EXPECT_EQ(event.branching->type, BranchType::pitchfork);
    const auto id = static_cast<std::size_t>(n);
    const BranchRecord& record = graph.records[id];
    const test::Branch& branch = graph.branches[id];
    EXPECT_EQ(record.parent, 0);
    EXPECT_EQ(record.origin, event.branching);
    EXPECT_TRUE(record.mirror_image);
    EXPECT_EQ(branch.end.reason, EndReason::stop);
    EXPECT_NEAR(branch.last().state.lambda, 8.0, 1e-12);
    EXPECT_EQ(branch.arcs.at(1).to.count.unstable, Index{n - 1});
    for (std::size_t i = 1; i < branch.arcs.size(); ++i)
      EXPECT_GT(branch.arcs[i].to.state.lambda, branch.arcs[i - 1].to.state.lambda);
  }
}

// Node contact, so only the order of things is the continuum's: Euler load, upper wall, snap, lower wall, λ = 10.
TEST(PerfectChannel, IsFollowedToTheLowerWallWithoutCycling) {
  for (const int elements : {20, 40}) {
    const test::ContactModel model = test::Channel{.elements = elements}.model();
    const auto middle = middle_of(model);
    TraceOptions trace = until(10.0);
    trace.node_contacts.assign(static_cast<std::size_t>(model.system().contact_count()), 1);
    const test::Graph graph =
        test::explore(model.system(), trace, {.policy = BranchPolicy::most_stable, .preference = {middle}});

    ASSERT_EQ(graph.records.size(), 2U);
    const Event buckling = only_event(graph.branches[0], EventKind::branch_point);
    EXPECT_NEAR(buckling.state.lambda, buckling_load(1), 1e-6);
    const auto closes = events_of(graph.branches[1], EventKind::contact_closes);
    ASSERT_FALSE(closes.empty());
    EXPECT_NEAR(closes[0].state.lambda, 0.435739888353, 2e-6);  // the elastica touches
    EXPECT_EQ(graph.branches[1].end.reason, EndReason::stop);
    EXPECT_NEAR(graph.branches[1].last().state.lambda, 10.0, 1e-12);
    EXPECT_NEAR(middle->value(graph.branches[1].last().state), -0.15, 1e-12);
    for (const Event& event : events_of(graph.branches[1], EventKind::branch_point))
      EXPECT_TRUE(event.branching->mesh_artefact);
  }
}

}  // namespace arcwall::branches_test
