// A ring that is pressed onto a plate rolls aside as soon as its contact spreads: the other branch leaves the corner at
// which the flat part begins. Until then the ring is stable where it stands; with a small side force it rolls aside and
// stays stable, near the same load.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/model/traced_session.hpp"

namespace arcwall::pitchfork_at_corner_test {
namespace {

std::string ring(const std::string& side_force) {
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
monitor = [{ name = "down", at = "top", component = "z", sign = -1 }]
[member]
nw = { from = "top", to = "west", via = [-35.3553390593, 35.3553390593], theory = "classic", material = "steel", section = "strip", elements = 16 }
bottom = { from = "west", to = "east", via = [0.0, -50.0], theory = "classic", material = "steel", section = "strip", elements = 32 }
ne = { from = "top", to = "east", via = [35.3553390593, 35.3553390593], theory = "classic", material = "steel", section = "strip", elements = 16 }
soft = { from = "sky", to = "top", theory = "classic", hinge = ["from", "to"], material = "soft", section = "spring", elements = 1 }
)toml";
}

Session traced(const std::string& side_force, const std::vector<std::string>& assignments = {}) {
  return test::traced(ring(side_force), assignments);
}

TEST(PitchforkAtACorner, IsAnEventWhereStabilityIsLostWithANewFlatPart) {
  const Session run = traced("0.0", {"path.branches=\"primary\""});
  const RecordEvent& spreads = test::event_of(run.record(), EventKind::contact_spreads);
  const RecordEvent& pitchfork = test::event_of(run.record(), EventKind::branch_point);
  EXPECT_EQ(spreads.unstable_before, 0);
  EXPECT_EQ(spreads.unstable_after, 0);
  EXPECT_EQ(pitchfork.lambda, spreads.lambda);
  EXPECT_EQ(pitchfork.branch_type, BranchType::symmetric);
  EXPECT_EQ(pitchfork.unstable_before, 0);
  EXPECT_EQ(pitchfork.unstable_after, 1);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop);
}

// The branch cannot be entered: its flat part has no length at first. Who wants the stable way is told so.
TEST(PitchforkAtACorner, EndsAPathThatIsToBeStable) {
  const Session run = traced("0.0");
  EXPECT_EQ(test::events_of(run.record(), EventKind::branch_point).size(), 1u);
  EXPECT_EQ(run.record().branches.size(), 1u);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::min_step);
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
