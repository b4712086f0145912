// Walls that come to places which supports hold, or these to walls: no contact force moves them, so the path ends
// there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/traced_deck.hpp"

namespace arcwall::held_ends_test {
namespace {

using test::TracedDeck;

std::string beam(const std::string& rest) {
  return R"toml(
title = "A beam whose ends are held"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1.0e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
member.c = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 8 }
)toml" + rest;
}

// `size`: of the structure [length of way per λ].
void expect_end_at(const std::string& deck, double lambda, const std::string& place, double size = 1.0) {
  const TracedDeck traced(deck);
  const BranchEnd& end = *traced.record().branches.back().end;
  EXPECT_EQ(end.reason, EndReason::jammed);
  EXPECT_NE(end.detail.find(place), std::string::npos) << end.detail;
  EXPECT_LE(traced.last().lambda, lambda + 1e-9 * size);
  EXPECT_GE(traced.last().lambda, lambda - 1e-5);
}

TEST(HeldEnds, AnEndIsLoweredOntoAFloor) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(beam(fmt::format(R"toml(
support = {{ a = ["x", "z", "rotation"], b = ["x", "rotation"] }}
prescribed = [{{ at = "b", z = -0.003 }}]
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -0.002 }} }}]
contact.points = "{}"
path = {{ step = 0.05, branches = "primary", stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                   points)),
                  2.0 / 3.0, "floor at c:1");
}

TEST(HeldEnds, AFloorRisesToSupports) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(beam(fmt::format(R"toml(
support = {{ a = ["x", "z"], b = ["x", "z"] }}
wall = [{{ name = "floor", side = "below", contact_surface = "axis", profile = {{ type = "flat", z = -0.002 }}, motion = {{ z = 0.004 }} }}]
load = [{{ at = "c:0.5", force = [0.0, 1.0e-3], constant = true }}]
contact.points = "{}"
path = {{ step = 0.05, branches = "primary", stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                   points)),
                  0.5, "floor at c:");
}

// Fingers of height 0.5 along x, held at their roots, and a straight wall above them.
std::string fingers(double normal_x, double normal_z, const std::string& rest, const std::string& points) {
  return fmt::format(R"toml(
title = "Fingers below a wall"
material.steel = {{ E = 2.0e5 }}
section.s = {{ shape = "rectangle", width = 5.0, height = 0.5 }}
point = {{ a = [0.0, 5.0], b = [30.0, 5.0], c = [100.0, 5.0], d = [70.0, 5.0] }}
support = {{ a = ["x", "z", "rotation"], c = ["x", "z", "rotation"] }}
member.left = {{ from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 10 }}
member.right = {{ from = "c", to = "d", theory = "elastica", material = "steel", section = "s", elements = 10 }}
contact.points = "{3}"
path = {{ step = 0.5, stop = {{ lambda = [-1.0, 12.0] }} }}
[[wall]]
name = "press"
outline = {{ type = "half-plane", point = [0.0, 8.0], normal = [{0}, {1}] }}
{2})toml",
                     normal_x, normal_z, rest, points);
}

// Both fingers are flush with the wall when it comes to their roots: no more elements would find an equilibrium.
TEST(HeldEnds, AWallComesDownOnMembersThatAreFlushWithIt) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(fingers(0.0, -1.0, "motion = { z = -1.0 }", points), 8.0 - 5.0 - 0.25, "press at left:0", 100.0);
}

// It rises from the root on, so that it touches nothing else.
TEST(HeldEnds, ASlopingWallReachesARootFirst) {
  const double angle = 0.2;
  for (const char* points : {"moving", "nodes"})
    expect_end_at(fingers(std::sin(angle), -std::cos(angle), "motion = { z = -1.0 }\nmembers = [\"left\"]", points),
                  8.0 - 5.0 - 0.25 / std::cos(angle), "press at left:0", 100.0);
}

TEST(HeldEnds, ASupportLiftsItsMemberToAWall) {
  for (const char* points : {"moving", "nodes"})
    expect_end_at(fingers(0.0, -1.0, "members = [\"left\"]\n[[prescribed]]\nat = \"a\"\nz = 1.0\n", points),
                  8.0 - 5.0 - 0.25, "press at left:0", 100.0);
}

}  // namespace
}  // namespace arcwall::held_ends_test
