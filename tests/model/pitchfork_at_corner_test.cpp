// A ring that is pressed onto a plate rolls aside as soon as its contact spreads: the other branch leaves the corner at
// which the flat part begins. Until then the ring is stable where it stands, and rolls aside behind it; so it does near
// the same load with a small side force.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "continuation/metric.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::pitchfork_at_corner_test {
namespace {

std::string ring(const std::string& side_force, int of_bottom) {
  return R"toml(
title = "A ring pressed onto a plate"
units = { length = "mm", force = "N" }
material.steel = { E = 2.1e5 }
material.soft = { E = 1.0 }
section.strip = { shape = "rectangle", width = 10.0, height = 1.0 }
section.spring = { shape = "general", A = 0.01, I = 1.0 }
point = { top = [0.0, 50.0], west = [-50.0, 0.0], east = [50.0, 0.0], sky = [0.0, 250.0] }
support = { top = ["x", "rotation"], sky = ["x", "z"] }
load = [
  { at = "top", force = [0.0, -1.0] },
  { at = "top", force = [0.0, -5.0], constant = true },
  { at = "west", force = [)toml" +
         side_force + R"toml(, 0.0], constant = true },
]
wall = [{ name = "plate", side = "below", members = ["bottom"], profile = { type = "flat", z = -50.6 } }]
path = { step = 1.0, stop = { down = [-0.1, 40.0] } }
monitor = [
  { name = "down", at = "top", component = "z", sign = -1 },
  { name = "west", at = "west", component = "x" },
  { name = "east", at = "east", component = "x" },
]
[member]
nw = { from = "top", to = "west", via = [-35.3553390593, 35.3553390593], theory = "euler-bernoulli", material = "steel", section = "strip", elements = 16 }
bottom = { from = "west", to = "east", via = [0.0, -50.0], theory = "euler-bernoulli", material = "steel", section = "strip", elements = )toml" +
         std::to_string(of_bottom) + R"toml( }
ne = { from = "top", to = "east", via = [35.3553390593, 35.3553390593], theory = "euler-bernoulli", material = "steel", section = "strip", elements = 16 }
soft = { from = "sky", to = "top", theory = "euler-bernoulli", hinge = ["from", "to"], material = "soft", section = "spring", elements = 1 }
)toml";
}

Session traced(const std::string& side_force, const std::vector<std::string>& assignments = {}, int of_bottom = 32) {
  return test::traced(ring(side_force, of_bottom), assignments);
}

TEST(PitchforkAtACorner, IsAnEventWhereStabilityIsLostWithANewFlatPart) {
  const Session run = traced("0.0", {"path.branches=\"primary\""});
  const RecordEvent& spreads = test::event_of(run.record(), EventKind::contact_spreads);
  const RecordEvent& pitchfork = test::event_of(run.record(), EventKind::branch_point);
  EXPECT_EQ(spreads.unstable_before, 0);
  EXPECT_EQ(spreads.unstable_after, 0);
  EXPECT_EQ(pitchfork.lambda, spreads.lambda);
  EXPECT_EQ(pitchfork.branch_type, BranchType::pitchfork);
  EXPECT_EQ(pitchfork.unstable_before, 0);
  EXPECT_EQ(pitchfork.unstable_after, 1);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
}

// Along the mode the whole ring rolls to one side. The ends of the spring, which can be turned nearly without force,
// are nearer to an eigenvalue of zero.
TEST(PitchforkAtACorner, HasTheModeThatGivesWay) {
  const Session run = traced("0.0");
  const BranchPoint& pitchfork = *run.record().branch_points.front().point;
  const Metric metric(run.model().system().weights(pitchfork.state.active_set), 1.0);
  EXPECT_NEAR(metric.norm(pitchfork.mode), 1.0, 1e-9);
  const auto moves = [&](std::size_t monitor) {
    return apply(run.model().monitors()[monitor].quantity->gradient(pitchfork.state), pitchfork.mode);
  };
  EXPECT_GT(std::abs(moves(1)), 10.0);  // mm, of a ring of 100 mm whose nodes move by as much on average
  EXPECT_NEAR(moves(1), moves(2), 1e-6 * std::abs(moves(1)));
}

// At the corner the branch's flat part has no length, so that no step begins there; it is entered behind, on meshes
// whose branch point lies in the corner and on those where it comes a little before. With the side force of 0.001 the
// ring is on the same path away from the corner.
TEST(PitchforkAtACorner, IsLeftAlongTheStableBranchSlow) {
  const Session pushed = traced("0.001");
  const double expected = pushed.record().points.back().lambda;  // down = 40
  for (const int of_bottom : {12, 18, 24, 32, 44, 64}) {
    SCOPED_TRACE(of_bottom);
    const Session run = traced("0.0", {}, of_bottom);
    const Record& record = run.record();
    ASSERT_EQ(record.branches.size(), 2u);
    EXPECT_EQ(record.branches.front().end->reason, EndReason::switched_branch);
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
    EXPECT_TRUE(record.branches.back().mirror_image);
    const RecordEvent& pitchfork = test::event_of(record, EventKind::branch_point);
    EXPECT_NEAR(pitchfork.lambda, 190.05204, 2e-3);
    EXPECT_EQ(pitchfork.branches, std::vector<Index>{1});
    const RecordEvent& start = test::event_of(record, EventKind::start, 2);
    EXPECT_EQ(start.lambda, pitchfork.lambda);
    EXPECT_EQ(record.points.back().count.unstable, 0);
    EXPECT_NEAR(record.points.back().lambda, expected, 1e-4 * expected);
  }
}

// Where zone and branch begin the mode's eigenvalue is zero, on a mesh but for its error and for round-off: neither may
// hide the branch. At 60 mm the elastica, whose ring lies flat between two spans without a moment at its edges, bears
// 374.4597324 (own shooting, to 1e-10).
TEST(PitchforkAtACorner, IsFoundOnAnyMeshSlow) {
  std::vector<double> sizes, errors;
  for (const int quarter : {6, 12, 24, 40, 64}) {
    SCOPED_TRACE(quarter);
    const std::string n = std::to_string(quarter);
    const Session run = traced(
        "0.0", {"member.nw.elements=" + n, "member.ne.elements=" + n, "path.stop.down=[-0.1, 60.0]"}, 2 * quarter);
    const Record& record = run.record();
    ASSERT_EQ(record.branches.size(), 2u);
    const RecordEvent& pitchfork = test::event_of(record, EventKind::branch_point);
    EXPECT_EQ(pitchfork.lambda, test::event_of(record, EventKind::contact_spreads).lambda);
    EXPECT_EQ(test::events_of(record, EventKind::branch_point).size(), 1u);
    EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
    sizes.push_back(1.0 / quarter);
    errors.push_back(record.points.back().lambda - 374.4597324);
  }
  EXPECT_LT(std::abs(errors.back()), std::pow(sizes.back() / sizes.front(), 3.8) * std::abs(errors.front()));
  EXPECT_NEAR(errors.back(), 0.0, 1e-5);
}

TEST(PitchforkAtACorner, LeavesBothWaysWhereAllAreTraced) {
  const Session run = traced("0.0", {"path.branches=\"all\""});
  ASSERT_EQ(run.record().branches.size(), 2u);  // and its mirror image
  EXPECT_EQ(run.record().branches.front().end->reason, EndReason::stop);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
}

// The structure follows the branch: nothing falls.
TEST(PitchforkAtACorner, IsNoFall) {
  const Session run = traced("0.0", {"path.jumps=true"});
  EXPECT_EQ(test::event_of(run.record(), EventKind::branch_point).jump, nullptr);
}

// A checkpoint may be written between the branch point and the corner, or before the branch's first step.
TEST(PitchforkAtACorner, IsLeftBehindACheckpointToo) {
  for (const int of_bottom : {24, 32}) {
    SCOPED_TRACE(of_bottom);
    const std::string deck = ring("0.0", of_bottom);
    const std::vector<std::string> short_path{"path.jumps=false", "path.stop.down=[-0.1, 30.0]"};
    Session whole = make_session({.deck = "deck.toml", .deck_text = deck, .assignments = short_path});
    ASSERT_TRUE(whole.begin());
    std::vector<std::string> checkpoints;
    while (whole.next() != nullptr)
      if (!test::events_of(whole.record(), EventKind::branch_point).empty()) checkpoints.push_back(whole.checkpoint());
    ASSERT_GT(checkpoints.size(), 3u);
    checkpoints.resize(4);
    for (const std::string& checkpoint : checkpoints) {
      Session resumed = resume_session(checkpoint, "checkpoint", Session::Resume::go_on);
      while (resumed.next() != nullptr) {
      }
      ASSERT_EQ(resumed.record().points.size(), whole.record().points.size());
      EXPECT_EQ(resumed.record().points.back().state.x, whole.record().points.back().state.x);
    }
  }
}

// A side force takes from the load of the pitchfork what goes with its 2/3rd power, 2e-5 to 1e-4 of it here.
TEST(PitchforkAtACorner, IsWhereASmallSideForceRollsTheRingAsideSlow) {
  const Session perfect = traced("0.0"), pushed = traced("0.001");
  const RecordEvent& at = test::event_of(perfect.record(), EventKind::branch_point);
  const RecordEvent& spreads = test::event_of(pushed.record(), EventKind::contact_spreads);
  EXPECT_TRUE(test::events_of(pushed.record(), EventKind::branch_point).empty());
  EXPECT_EQ(spreads.unstable_after, 0);
  EXPECT_EQ(pushed.record().branches.back().end->reason, EndReason::stop);
  EXPECT_NEAR(spreads.lambda, at.lambda, 1e-4 * at.lambda);
}

}  // namespace
}  // namespace arcwall::pitchfork_at_corner_test
