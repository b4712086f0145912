// Bodies that nothing but contact holds: they fall onto it, are pressed on it, or are pushed to it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "apps/output/exit_status.hpp"
#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// A beam of EI = 1000 · 8/3, 120 long, over round props that are 100 apart; a nose comes down on its middle [mm, N].
std::string three_point_bending(double props, double nose, const std::string& more = "") {
  return fmt::format(R"(
title = "Three-point bending"
material.m = {{ E = 1000.0 }}
section.s = {{ shape = "rectangle", width = 4.0, height = 2.0 }}
point = {{ A = [-60.0, 0.0], B = [60.0, 0.0] }}
member.beam = {{ from = "A", to = "B", theory = "elastica", material = "m", section = "s", elements = 24 }}
[[wall]]
name = "left"
contact_surface = "axis"
outline = {{ type = "circle", centre = [-50.0, {0:.17g}], radius = 5.0 }}
[[wall]]
name = "right"
contact_surface = "axis"
outline = {{ type = "circle", centre = [50.0, {0:.17g}], radius = 5.0 }}
[[wall]]
name = "nose"
contact_surface = "axis"
outline = {{ type = "circle", centre = [0.0, {1:.17g}], radius = 5.0 }}
motion = {{ z = -1.0 }}
[path]
step = 0.02
[[monitor]]
name = "push"
wall = "nose"
component = "force-z"
sign = -1
[[monitor]]
name = "middle"
at = "beam:0.5"
component = "z"
)",
                     props, nose) +
         more;
}

// A hook that a force pushes along x to a catch, and nothing else holds in that direction [mm, N].
const std::string pushed_hook =
    title("Hook") + material("pa", 2400.0) + rectangle("hook", 5.0, 1.5) +
    points({{"base", 0.0, 0.0}, {"tip", 20.0, 0.0}, {"nose", 20.0, -1.5}}) + supports({{"base", "z rotation"}}) +
    member("beam", "base", "tip", "elastica", 8, "", "pa", "hook") +
    member("nose", "tip", "nose", "elastica", 2, "", "pa", "hook") + force("base", 1.0, 0.0) +
    wall(
        "catch",
        R"(side = "below"; contact_surface = "axis"; members = ["nose"]; profile = { type = "parabola", apex = [25.0, -0.5], curvature = -0.2 })") +
    path("step = 0.01") + monitor("way", "base", "x") + monitor("lift", "tip", "z") + "[path.stop]\n";

double monitored(const RecordPoint& point, std::size_t which) { return point.monitors[which]; }

}  // namespace

// In small slopes P = 48 EI w/ℓ³ = 0.128 w. Nothing holds the beam along x, and nothing pushes it.
TEST(LooseBodies, AreBentOverProps) {
  const TracedDeck bent(three_point_bending(-5.0, 5.0, "[path.stop]\nlambda = [-0.01, 0.1]\n"));
  const RecordPoint& last = bent.record().points.back();
  ASSERT_EQ(last.lambda, 0.1);
  EXPECT_NEAR(monitored(last, 0), 0.0128, 2e-5);
  EXPECT_NEAR(monitored(last, 1), -0.1, 1e-9);
  EXPECT_EQ(bent.model().warnings().size(), 1u);
  EXPECT_NE(bent.model().warnings().front().find("A in x and z, B in x and z"), std::string::npos);
  expect_confirmed(bent);
}

// An A-frame of bars, two steep and a soft tie of stiffness k, is pressed on a smooth floor: its feet spread by u,
// where P = 2 k u tan α. What keeps it from sliding away bears none of that, however much stiffer it is than the tie.
TEST(LooseBodies, AreDeformedAsIfNothingHeldThem) {
  constexpr double k = 20.0, P = 5.0;
  const TracedDeck spread(
      title("A-frame with a soft tie") + units("m", "N") + material("m", 2.1e11) + general_section("s", 0.01, 1e-6) +
      points({{"a", -1.0, 0.0}, {"t", 0.0, 1.0}, {"b", 1.0, 0.0}}) +
      path("step = 1.0; stop = { lambda = [-1.0, 5.0] }") + bar("l", "a", "t") + bar("r", "t", "b") +
      force("t", 0.0, -1.0) + table("[[spring]]", R"(between = ["a", "b"]; stiffness = { x = 20.0 })") +
      flat_wall("floor", "below", 0.0, on_axis) + monitor("a", "a", "x") + monitor("b", "b", "x"));
  const RecordPoint& last = spread.record().points.back();
  ASSERT_EQ(last.lambda, P);
  const double u = monitored(last, 1) - monitored(last, 0), half = 0.5 * (2.0 + u);
  EXPECT_NEAR(2.0 * k * u * std::sqrt(2.0 - half * half) / half, P, 1e-6 * P);
  EXPECT_NEAR(u, 0.145515, 1e-6);
}

// Half a millimetre above its props the beam falls onto them: it rests with the deflection of its weight, between two
// props with ends that overhang, and the nose meets it there.
TEST(LooseBodies, FallOntoWhatHoldsThem) {
  const double q = 1e-4, EI = 1000.0 * 8.0 / 3.0, l = 100.0, a = 10.0;
  const TracedDeck rests(three_point_bending(
      -5.5, 6.0, distributed("beam", 0.0, -0.0001, constant) + table("[path.stop]", "lambda = [-0.1, 2.0]")));
  const double sag = q * l * l * (5.0 * l * l - 24.0 * a * a) / (384.0 * EI);
  EXPECT_NEAR(monitored(rests.record().points.front(), 1), -0.5 - sag, 1e-3 * sag);
  const auto meets = events_of(rests, EventKind::contact_closes);
  ASSERT_FALSE(meets.empty());
  EXPECT_NEAR(meets.front().lambda, 1.5 + sag, 1e-3 * sag);
  expect_confirmed(rests);
}

// The hook goes to the catch without a force worth the name, over it with one, and on without. It touches where the
// parabola is as high as its nose, at 25 ∓ √10.
TEST(LooseBodies, ArePushedToWhatHoldsThem) {
  const TracedDeck pushed(pushed_hook + "way = [-0.1, 12.0]\n");
  const auto meets = events_of(pushed, EventKind::contact_closes), leaves = events_of(pushed, EventKind::contact_opens);
  ASSERT_EQ(meets.size(), 1u);
  ASSERT_EQ(leaves.size(), 1u);
  EXPECT_NEAR(meets[0].monitors[0], 5.0 - std::sqrt(10.0), 1e-7);
  EXPECT_NEAR(leaves[0].monitors[0], 5.0 + std::sqrt(10.0), 1e-6);
  EXPECT_LT(std::abs(meets[0].lambda), 1e-5);
  EXPECT_LT(std::abs(leaves[0].lambda), 1e-5);
  EXPECT_EQ(events_of(pushed, EventKind::limit_point).size(), 2u);
  expect_confirmed(pushed);
}

// Nothing lies where the force pushes.
TEST(LooseBodies, AreNotFollowedWhereNothingHoldsThem) {
  const TracedDeck lost(pushed_hook + "lambda = [-1.0, 1.0]\n", {"load.0.force=[-1.0, 0.0]"});
  const auto& end = lost.record().branches.back().end;
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(end->reason, EndReason::rigid_body_motion);
  EXPECT_NE(end->detail.find("\"base\""), std::string::npos) << end->detail;
}

// Walls that do not concern what is loose hold nothing.
TEST(LooseBodies, AreStillRefusedWithoutAWall) {
  std::string deck = pushed_hook;
  const std::string nose = "members = [\"nose\"]";
  deck.erase(deck.find("[[wall]]"), deck.find("[path]") - deck.find("[[wall]]"));
  EXPECT_THROW(TracedDeck(deck + "lambda = [-1.0, 1.0]\n"), InputError);
}

// A ring of radius 30 between plates: F = (EI/R³)/(π/4 − 2/π) times the way while that is small. It may roll and slide,
// and does not.
TEST(LooseBodies, AreSqueezedBetweenPlates) {
  const TracedDeck ring(title("Ring") + material("m", 5.0) + rectangle("s", 20.0, 2.0) +
                        points({{"west", -30.0, 0.0}, {"east", 30.0, 0.0}}) +
                        member("under", "west", "east", "elastica", 24, "via = [0.0, -30.0]") +
                        member("over", "east", "west", "elastica", 24, "via = [0.0, 30.0]") +
                        flat_wall("floor", "below", -30.0, on_axis) +
                        flat_wall("plate", "above", 30.0, R"(contact_surface = "axis"; motion = { z = -1.0 })") +
                        path(R"(step = 0.02; branches = "primary"; stop = { lambda = [-0.1, 0.1] })") +
                        wall_monitor("force", "plate", "force-z", flipped));
  const RecordPoint& last = ring.record().points.back();
  ASSERT_EQ(last.lambda, 0.1);
  const double EI = 5.0 * 20.0 * 8.0 / 12.0, pi = 3.14159265358979;
  EXPECT_NEAR(monitored(last, 0), 0.1 * EI / 27000.0 / (pi / 4.0 - 2.0 / pi), 2e-2 * monitored(last, 0));
  expect_confirmed(ring);
}

// A heavy pipe over a trench of length l is lifted off the ground for b on both sides of it, in small slopes:
//
//     b³ + 3 l b² − l³ = 0,     M = q l²/8 − q b²/4,     w = 5 q l⁴/(384 EI) − q b² l²/(32 EI)
//
// M and w at the middle. Contact at nodes knows b to an element. That the pipe moves as a whole resists only contact at
// 82 nodes, all without force at the start.
TEST(LooseBodies, AHeavyPipeThatLiesOnBothSidesOfATrenchSagsIntoIt) {
  const TracedDeck traced(
      title("A pipe over a trench") + units("m", "kN") + material("s", 2.1e8) +
      general_section("r", 0.01, 1e-5, "height = 0.2") + points({{"a", -40.0, 0.1}, {"b", 40.0, 0.1}}) +
      supports({{"a", "x"}}) + member("p", "a", "b", "elastica", 160, "", "s", "r") + distributed("p", 0.0, -1.0) +
      wall("left", R"(outline = { type = "polyline", x = [-60.0, -10.0, -10.0], z = [0.0, 0.0, -5.0] })") +
      wall("right", R"(outline = { type = "polyline", x = [10.0, 10.0, 60.0], z = [-5.0, 0.0, 0.0] })") +
      wall_monitor("fl", "left", "force-z") + wall_monitor("fr", "right", "force-z") +
      monitor("w", "p:0.5", "z", flipped) + monitor("M", "p:0.5", "moment") + contact(R"(points = "nodes")") +
      path("step = 0.05; stop = { lambda = [-0.1, 1.0] }"));
  expect_confirmed(traced);
  const double l = 20.0, q = 1.0, EI = 2.1e3, element = 0.5;
  const double b = l * (2.0 * std::cos(2.0 * pi / 9.0) - 1.0);
  ASSERT_NEAR(b * b * b + 3.0 * l * b * b - l * l * l, 0.0, 1e-9);
  const double of_moment = 0.5 * q * b * element;  // dM/db
  const std::vector<double>& last = traced.record().points.back().monitors;
  EXPECT_NEAR(last[0] + last[1], 80.0, 1e-5);
  EXPECT_NEAR(last[2], 5.0 * q * std::pow(l, 4) / (384.0 * EI) - q * b * b * l * l / (32.0 * EI),
              of_moment * l * l / (8.0 * EI));
  EXPECT_NEAR(last[3], q * l * l / 8.0 - q * b * b / 4.0, of_moment);
}

}  // namespace arcwall::loading_test
