// Steps are as long as the structure's motion allows, whatever λ is and however it compares with what it was at first.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "core/root_find.hpp"
#include "core/types.hpp"
#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::steps_of_slender_structures_test {

using namespace test::tables;

namespace {

const std::string pushed_strip = title("A strip with L/h = 1000, pushed together") + material("m", 2.0e11) +
                                 rectangle("s", 0.02, 0.001) + points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}}) +
                                 supports({{"a", "x z"}, {"b", "z"}}) + path("stop = { lambda = [-1.0e-6, 0.8] }") +
                                 prescribed("b", "x = -1.0") + monitor("mid", "s:0.5", "z") +
                                 member("s", "a", "b", "elastica", 20, imperfection({{1, 1.0e-4}}));

constexpr const char* hanging_rope = R"toml(
title = "A rope of 1000 m that hangs by its weight, its ends then brought together by 50 m"
material.m = { E = 1.0e11 }
section.s = { shape = "circle", radius = 0.025 }
point = { a = [0.0, 0.0], b = [1000.0, 0.0] }
support = { a = ["x", "z"], b = ["x", "z"] }
load = [{ on = "s", distributed = [0.0, -151.0], constant = true }]
prescribed = [{ at = "b", x = -50.0 }]
path = { stop.lambda = [-1.0e-6, 1.0] }
monitor = [{ name = "mid", at = "s:0.5", component = "z" }, { name = "H", at = "b", component = "reaction-x" }]
[member.s]
from = "a"
to = "b"
theory = "elastica"
material = "m"
section = "s"
elements = 60
)toml";

// Horizontal force and sag of an elastic catenary of this length, stiffness and weight over a span (Irvine 1981).
struct Catenary {
  double length, stiffness, weight;

  double span(double H) const {
    const double V = 0.5 * weight * length;
    return 2.0 * H / weight * std::asinh(V / H) + H * length / stiffness;
  }
  double force(double over) const {
    const auto excess = [&](double H) -> std::optional<double> { return span(H) - over; };
    return bracketed_root(excess, 1e3, *excess(1e3), 1e7, *excess(1e7), 1e-12)->at;
  }
  double sag(double H) const {
    const double half = 0.5 * length, V = weight * half;
    return H / weight * (std::hypot(1.0, V / H) - 1.0) + weight * half * half / (2.0 * stiffness);
  }
};

// Two leaves clamped side by side, the upper one longer; springs that press alone lie between them. The load is 1000 λ.
std::string stacked_leaves() {
  std::string points, members, springs;
  for (int i = 0; i <= 8; ++i) {
    points += fmt::format("a{0} = [{1}.0, 0.0]\n", i, 75 * i);
    if (i <= 6) points += fmt::format("b{0} = [{1}.0, -8.0]\n", i, 75 * i);
    if (i == 0) continue;
    for (const char leaf : {'a', 'b'})
      if (leaf == 'a' || i <= 6)
        members += fmt::format(
            "{0}{1} = {{ from = \"{0}{2}\", to = \"{0}{1}\", theory = \"elastica\", material = \"steel\", section = "
            "\"leaf\", elements = 2 }}\n",
            leaf, i, i - 1);
    if (i <= 6)
      springs += fmt::format(
          "[[spring]]\nname = \"c{0}\"\nbetween = [\"a{0}\", \"b{0}\"]\nlaw = {{ direction = \"z\", displacement = "
          "[-100.0, 0.0, 0.001, 10.0], force = [0.0, 0.0, 10.0, 1.0e5] }}\n",
          i);
  }
  return "title = \"Two stacked leaves\"\nmaterial.steel = { E = 2.06e5 }\n"
         "section.leaf = { shape = \"rectangle\", width = 60.0, height = 8.0 }\n"
         "support = { a0 = [\"x\", \"z\", \"rotation\"], b0 = [\"x\", \"z\", \"rotation\"] }\n"
         "load = [{ at = \"a8\", force = [0.0, -1000.0] }]\n"
         "path = { stop.lambda = [-0.1, 3.0], output_at.lambda = [0.01] }\n"
         "monitor = [{ name = \"end\", spring = \"c6\", component = \"force-z\" }]\n[point]\n" +
         points + "[member]\n" + members + springs;
}

constexpr const char* pulled_switch = R"toml(
title = "Cantilever switch that closes, lies flat on its stop, and is pulled off"
material.si = { E = 1.6e5 }
section.beam = { shape = "rectangle", width = 30.0, height = 2.0 }
point = { anchor = [0.0, 0.0], tip = [300.0, 0.0] }
support.anchor = ["x", "z", "rotation"]
member.beam = { from = "anchor", to = "tip", theory = "elastica", material = "si", section = "beam", elements = 40 }
wall = [{ name = "stop", side = "below", contact_surface = "axis", profile = { type = "flat", z = -3.0 } }]
load = [{ on = "beam", distributed = [0.0, -1.0] }, { at = "tip", force = [0.0, 1.0] }]
stage = [{ name = "close", drives = ["load.0"], step = 0.005, stop = { lambda = [-0.1, 1.0] } },
         { name = "pull", drives = ["load.1"], step = 0.1, stop = { lambda = [-1.0, 1000.0], force = [0.001, 1.0e6] } }]
monitor = [{ name = "tip", at = "tip", component = "z" }, { name = "force", wall = "stop", component = "force-z" }]
)toml";

// Of the elastica whose ends come together by a part δ of its length, δ = 2 (1 − E(k)/K(k)).
double modulus_at(double shortening) {
  const auto excess = [&](double k) -> std::optional<double> {
    return 2.0 * (1.0 - std::comp_ellint_2(k) / std::comp_ellint_1(k)) - shortening;
  };
  return bracketed_root(excess, 0.1, *excess(0.1), 0.999, *excess(0.999), 1e-14)->at;
}

}  // namespace

// λ goes to 4·10⁴ times the buckling movement, over which its scale at the start would make 5000 steps of a fiftieth of
// the way.
TEST(PushedStrip, IsFollowedInStepsOfItsMotion) {
  const Session run = test::traced(pushed_strip);
  const Record& record = run.record();
  EXPECT_LE(record.points.size(), 100U);
  const RecordPoint& last = record.points.back();
  EXPECT_EQ(last.lambda, 0.8);
  const double k = modulus_at(0.8);
  // The imperfection is 10⁻⁴ of the length.
  EXPECT_NEAR(last.monitors[0], k / std::comp_ellint_1(k), 2e-4);
}

// A straight rope has no stiffness across itself: its weight moves it by tens of metres at 1e-5 of its value already.
TEST(HangingRope, ComesToHangInStepsOfItsMotion) {
  const Session run = test::traced(hanging_rope);
  const RecordPoint& last = run.record().points.back();
  EXPECT_EQ(last.lambda, 1.0);
  const Catenary rope{.length = 1000.0, .stiffness = 1e11 * std::numbers::pi * 0.025 * 0.025, .weight = 151.0};
  const double H = rope.force(950.0);
  EXPECT_NEAR(last.monitors[0], -rope.sag(H), 1e-4 * rope.sag(H));
  EXPECT_NEAR(last.monitors[1], H, 1e-4 * H);
}

// The springs' laws have kinks where the leaves stand at rest. In small slopes the shorter leaf bears the load's end by
// F (3L − a) a²/6EI over 2a³/3EI and the spring's 10⁻⁴; the others are open.
TEST(StackedLeaves, AreBentInStepsOfTheirMotion) {
  const Session run = test::traced(stacked_leaves());
  const Record& record = run.record();
  EXPECT_LE(record.points.size(), 100U);
  EXPECT_EQ(record.points.back().lambda, 3.0);
  const double EI = 2.06e5 * 60.0 * 8.0 * 8.0 * 8.0 / 12.0, L = 600.0, a = 450.0;
  const double share = (3.0 * L - a) * a * a / (6.0 * EI) / (2.0 * a * a * a / (3.0 * EI) + 1e-4);
  const auto at = std::find_if(record.points.begin(), record.points.end(),
                               [](const RecordPoint& point) { return point.lambda == 0.01; });
  ASSERT_NE(at, record.points.end());
  EXPECT_NEAR(at->monitors[0], 10.0 * share, 1e-4 * 10.0 * share);
}

// At the end the beam touches its stop without force: the force at its tip is the one with which, in small slopes, it
// reaches −3 under its load and no farther. Its slopes are up to 0.13.
TEST(PulledSwitch, PeelsOffInStepsOfItsMotion) {
  const Session run = test::traced(pulled_switch);
  const Record& record = run.record();
  EXPECT_LE(record.points.size(), 100U);
  EXPECT_EQ(record.stage_of(record.points.back().branch), "pull");
  EXPECT_NEAR(record.points.back().monitors[1], 0.001, 1e-9);
  constexpr double EI = 1.6e5 * 20.0, L = 300.0;
  const auto lowest = [](double force) {
    double least = 0.0;
    for (double x = 0.0; x <= L; x += 0.01 * L)
      least = std::min(least, force * x * x * (3.0 * L - x) / (6.0 * EI) -
                                  x * x * (x * x - 4.0 * L * x + 6.0 * L * L) / (24.0 * EI));
    return least;
  };
  const auto excess = [&](double force) -> std::optional<double> { return lowest(force) + 3.0; };
  const double small_slopes = bracketed_root(excess, 100.0, *excess(100.0), 150.0, *excess(150.0), 1e-10)->at;
  EXPECT_NEAR(record.points.back().lambda, small_slopes, 0.13 * 0.13 * small_slopes);
}

// Glue that softens holds the beam on its stop: it peels off at a maximum of λ and comes to rest at a minimum. By
// shooting from the edge of contact, in small slopes. While the beam lies flat its pull moves nothing, and no scale of
// λ is known.
TEST(PulledSwitch, PeelsOffGlueThroughTwoLimitPointsSlow) {
  std::string deck = pulled_switch;
  deck += R"toml(
[[spring]]
on = "beam"
law = { direction = "z", displacement = [-3.0, -2.95, -2.9, -2.8, -2.7, -2.6, 0.0], force = [1.0, 2.0, 1.5, 0.5, 0.1, 0.0, 0.0] }
)toml";
  const Session run = test::traced(deck, {"member.beam.elements=60"});
  const Record& record = run.record();
  EXPECT_EQ(record.branches.back().end->reason, EndReason::stop);
  std::vector<double> turns;
  for (const RecordEvent& event : record.events)
    if (record.stage_of(event.branch) == "pull") {
      EXPECT_NE(event.kind, EventKind::branch_point);
      if (event.kind == EventKind::limit_point) turns.push_back(event.lambda);
    }
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(turns[0], 57.84617, 1e-4 * 57.84617);
  EXPECT_NEAR(turns[1], 53.25396, 1e-4 * 53.25396);
  EXPECT_LE(std::count_if(record.points.begin(), record.points.end(),
                          [&](const RecordPoint& point) { return record.stage_of(point.branch) == "pull"; }),
            100);
}

// The load on the truss's top goes into the floor until it bears the constant load: no first step says how far it moves
// the truss. With Green's strain the top at z over its supports bears EA z (h² − z²)/L³, greatest at z = −h/√3.
TEST(LiftedTruss, IsFollowedInStepsOfItsMotionOnceItIsFree) {
  const Session run = test::traced(R"toml(
title = "A two-bar truss that a load has snapped onto a floor, and that is pulled off"
material.m = { E = 1e7 }
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { l = [0.0, 0.0], top = [10.0, 1.0], r = [20.0, 0.0] }
support = { l = ["x", "z"], r = ["x", "z"] }
member.left = { from = "l", to = "top", theory = "truss", strain = "green", material = "m", section = "s", elements = 1 }
member.right = { from = "top", to = "r", theory = "truss", strain = "green", material = "m", section = "s", elements = 1 }
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = -1.2 } }]
load = [{ at = "top", force = [0.0, 1.0] }, { at = "top", force = [0.0, -1e4], constant = true }]
path = { step = 0.1, jumps = false, stop = { lambda = [-1.0, 3e4] } }
)toml");
  const Record& record = run.record();
  EXPECT_LE(record.points.size(), 100U);
  EXPECT_EQ(record.points.back().lambda, 3e4);
  const double L = std::sqrt(101.0), borne = 1e7 / (L * L * L), greatest = borne * 2.0 / std::pow(3.0, 1.5);
  const auto opens = test::events_of(record, EventKind::contact_opens);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(opens[0].lambda, 1e4 - borne * 1.2 * (1.2 * 1.2 - 1.0), 1e-6);
  const auto turns = test::events_of(record, EventKind::limit_point);
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(turns[0].lambda, 1e4 + greatest, 1e-6);
  EXPECT_NEAR(turns[1].lambda, 1e4 - greatest, 1e-6);
}

}  // namespace arcwall::steps_of_slender_structures_test
