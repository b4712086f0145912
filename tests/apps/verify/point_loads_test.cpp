#include <gtest/gtest.h>

#include "apps/verify/shown_values.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::verify::point_loads_test {

namespace {

using test::TracedDeck;

// A strip pressed onto a floor: the contact lies within an element of the load.
constexpr const char* strip = R"toml(
title = "A strip between clamps over a floor"
material.m = { E = 1.2e5 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { a = [0.0, 0.0], b = [10.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
member.beam = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 10 }
load = [{ at = "beam:0.4", force = [0.0, -1.0] }]
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = -0.01 } }]
path = { step = 0.1, stop = { lambda = [-1.0, 0.004] } }
)toml";

// The same states beside loads that are so many times the deck's.
Findings findings_of(const TracedDeck& traced, double times) {
  Findings findings;
  const Scales scales{};
  const std::vector<PlainWall> walls = walls_of(traced.model().deck());
  const PlainMembers members(traced.model());
  for (RecordPoint point : traced.record().points) {
    point.lambda *= times;
    check_point_loads(at_hand(traced.model(), members, point, walls, scales), findings);
  }
  return findings;
}

}  // namespace

TEST(VerifyPointLoads, AreThoseByWhichSectionForcesJump) {
  const TracedDeck traced(strip);
  test::expect_verified(traced);
  EXPECT_EQ(findings_of(traced, 1.0).failures(), 0);
  EXPECT_GT(findings_of(traced, 1.001).failures(), 2);
  ASSERT_EQ(findings_of(traced, 1.0).checks().size(), 1U);
}

// The place that is shown before the load is the contact itself, with the force before it.
TEST(VerifyPointLoads, HoldBesideAContactInTheNextElement) {
  test::expect_verified(TracedDeck(R"toml(
title = "A clamped arch that is pressed onto a bump beside its load"
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.15, height = 0.085 }
point = { left = [0.0, 0.0], right = [4.4, 0.0] }
support = { left = ["x", "z", "rotation"], right = ["x", "z", "rotation"] }
member.arch = { from = "left", to = "right", theory = "elastica", material = "m", section = "s", elements = 56, sine = { rise = 0.79, waves = 1 } }
load = [{ at = "arch:0.5", force = [0.0, -0.477] }]
wall = [{ name = "bump", side = "below", profile = { type = "circle", centre = [2.18, -0.82], radius = 1.0 } }]
path = { step = 0.05, stop = { lambda = [-3.0, 1.2] } }
)toml"));
}

}  // namespace arcwall::verify::point_loads_test
