// A rigid wall that comes to a place that supports hold cannot go on. Fingers of height 0.5 along x, held at their
// roots; λ at which the face of the root is reached follows from the wall's place alone.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::blocked_walls_test {
namespace {

constexpr const char* fingers = R"toml(
title = "Fingers below a wall that comes down on them"
material.steel = { E = 2.0e5 }
section.s = { shape = "rectangle", width = 5.0, height = 0.5 }
point = { a = [0.0, 5.0], b = [30.0, 5.0], c = [100.0, 5.0], d = [70.0, 5.0] }
support = { a = ["x", "z", "rotation"], c = ["x", "z", "rotation"] }
member.left = { from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 10 }
member.right = { from = "c", to = "d", theory = "elastica", material = "steel", section = "s", elements = 10 }
path = { step = 0.5, stop = { lambda = [-1.0, 12.0] } }
)toml";

std::string wall_with(double normal_x, double normal_z, const std::string& motion) {
  return "[[wall]]\nname = \"press\"\noutline = { type = \"half-plane\", point = [0.0, 8.0], normal = [" +
         round_trip(normal_x) + ", " + round_trip(normal_z) + "] }\n" + motion;
}

void expect_blocked(const std::string& deck, double lambda, const std::string& place) {
  for (const std::string points : {"moving", "nodes"}) {
    SCOPED_TRACE(points);
    const Session run = test::traced(deck, {"contact.points=\"" + points + "\""});
    const BranchEnd& end = run.record().branches.back().end.value();
    EXPECT_EQ(end.reason, EndReason::jammed);
    EXPECT_NE(end.detail.find(place), std::string::npos) << end.detail;
    EXPECT_NEAR(run.record().points.back().lambda, lambda, 1e-6);
  }
}

}  // namespace

// Both fingers are flush with the wall when it comes to their roots.
TEST(Walls, EndAtTheRootsOfMembersThatAreFlushWithThem) {
  expect_blocked(fingers + wall_with(0.0, -1.0, "motion = { z = -1.0 }"), 8.0 - 5.0 - 0.25, "press at left:0");
}

// It rises from the root on, so that it touches nothing else.
TEST(Walls, EndAtARootThatTheyReachFirst) {
  const double angle = 0.2;
  expect_blocked(fingers + wall_with(std::sin(angle), -std::cos(angle), "motion = { z = -1.0 }\nmembers = [\"left\"]"),
                 8.0 - 5.0 - 0.25 / std::cos(angle), "press at left:0");
}

// A support that moves its point towards the wall.
TEST(Walls, EndTheWayOfASupportThatComesToThem) {
  expect_blocked(fingers + wall_with(0.0, -1.0, "members = [\"left\"]") +
                     "\n[[prescribed]]\nat = \"a\"\nz = 1.0\n",
                 8.0 - 5.0 - 0.25, "press at left:0");
}

}  // namespace arcwall::blocked_walls_test
