// Outlines with a radius for each corner, against circles in the place of the corners.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::corner_radii_test {
namespace {

// A clamped strip is pressed up against a wall, near the corner of which it touches.
std::string strip_under(const std::string& wall) {
  return R"toml(
title = "A strip under a plateau"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.c = { from = "a", to = "b", theory = "elastica", elements = 16, material = "m", section = "s" }
load = [{ at = "b", force = [0.0, 1.0] }]
path = { step = 0.1, stop = { lambda = [-0.5, 4.0] } }
monitor = [{ name = "tip", at = "b", component = "z" }]
[[wall]]
name = "plateau"
contact_surface = "axis"
)toml" + wall;
}

std::string plateau(const std::string& radii) {
  return "outline = { type = \"polyline\", x = [2.0, 0.7, 0.4, -1.0], z = [0.8, 0.08, 0.08, 0.8] }\ncorner_radius = " +
         radii + "\n";
}

}  // namespace

// The corner at x = 0.7 touches first, rounded with 0.1: as a circle of 0.1 about the centre of the arc. The other
// corner does not touch, however it is rounded.
TEST(CornerRadii, RoundEachCornerByItself) {
  const double turn = std::atan2(0.72, 1.3), r = 0.1, taken = r * std::tan(0.5 * turn);
  const test::TracedDeck circle(strip_under(fmt::format(
      "outline = {{ type = \"circle\", centre = [{:.17g}, {:.17g}], radius = 0.1 }}\n", 0.7 - taken, 0.08 + r)));
  for (const char* other : {"0.02", "0.3"}) {
    const test::TracedDeck corner(strip_under(plateau(fmt::format("[0.1, {}]", other))));
    EXPECT_NEAR(test::event_of(corner, EventKind::contact_closes).lambda,
                test::event_of(circle, EventKind::contact_closes).lambda, 1e-11);
    EXPECT_NEAR(corner.record().points.back().monitors[0], circle.record().points.back().monitors[0], 1e-9);
    test::expect_whole(corner);
  }
}

TEST(CornerRadii, ThatAreAllAlikeAreOneNumber) {
  const test::TracedDeck one(strip_under(plateau("0.1"))), list(strip_under(plateau("[0.1, 0.1]")));
  const test::TracedDeck given(strip_under(plateau("0.2")), {"wall.plateau.corner_radius=[0.1, 0.1]"});
  EXPECT_EQ(one.last().x, list.last().x);
  EXPECT_EQ(one.last().x, given.last().x);
}

TEST(CornerRadii, AreOneForEachCorner) {
  EXPECT_EQ(
      test::said_of(strip_under(plateau("[0.1]"))),
      "deck.toml:15:17: wall.0.corner_radius: has 1 radii, and the outline has 2 corners; give one for each point "
      "between the ends");
  EXPECT_EQ(test::said_of(strip_under(plateau("[0.1, -0.1]"))),
            "deck.toml:15:17: wall.0.corner_radius: must be at least 0; give radii that are not negative");
  EXPECT_EQ(test::said_of(strip_under(plateau("[0.1, 5.0]"))),
            "deck.toml:15:17: wall.0.corner_radius: the corner at (0.4, 0.08) cannot be rounded with 5: its lines are "
            "too short; give a smaller corner_radius");
}

}  // namespace arcwall::corner_radii_test
