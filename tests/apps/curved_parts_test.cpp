// Parts that are pressed on curved walls. Their pressure follows from where they lie, whatever the forces of their
// nodes say: those of a short part are lost in round-off, and beside a point of a spline they scatter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::curved_parts_test {

using namespace test::tables;
namespace {

const std::string column_on_a_wavy_floor =
    title("a column between a circle and a spline") + material("steel", 2.1e4) + rectangle("s", 0.0668, 0.02296) +
    points({{"left", 0.0, 0.0}, {"right", 1.636, 0.0}}) + supports({{"left", "x z"}, {"right", "z rotation"}}) +
    force("right", -0.01066, 0.0) + path("step = 0.05; jumps = false; stop = { lambda = [-1.0, 9.0] }") +
    member("column", "left", "right", "elastica", 54, imperfection({{1, -0.001076}, {3, 0.000363}}), "steel") +
    wall("upper", R"(side = "above"; profile = { type = "circle", centre = [0.755, 15.2745], radius = 15.2227 })") +
    wall(
        "lower",
        R"(side = "below"; profile = { type = "spline", x = [-0.409, -0.0584, 0.2922, 0.6428, 0.9934, 1.344, 1.6946, 2.0452], z = [-0.05621, -0.06019, -0.05208, -0.06044, -0.05879, -0.05545, -0.05648, -0.05983] })");

void expect_joined_touch(const std::string& elements) {
  const test::TracedDeck traced(column_on_a_wavy_floor, {"member.column.elements=" + elements});
  const auto joinings = test::events_of(traced, EventKind::contacts_merge);
  ASSERT_EQ(joinings.size(), 2U);
  EXPECT_NEAR(joinings[1].lambda, 5.36410922, 5e-9);
  test::expect_whole(traced);
}

}  // namespace

// A part joins a touch where its pressure vanishes at that end. Told from the forces of its nodes, the load was
// 5.6 ± 0.3 on 54 elements, and the run ended there on 108.
TEST(CurvedParts, JoinATouchWhereTheirPressureVanishesSlow) { expect_joined_touch("54"); }

TEST(CurvedParts, JoinATouchWhereTheirPressureVanishesOnAFineMeshNightly) { expect_joined_touch("108"); }

namespace {

// End moments bend a beam onto a hill that is next to flat: its pressure there is some 10⁻⁵ of EI/L³.
const std::string beam_on_a_flat_hill =
    title("a simple beam on a hill under end moments") + material("steel", 2.1e4) + rectangle("s", 0.655, 0.33355) +
    points({{"left", 0.0, 0.0}, {"right", 31.1635, 0.0}}) + supports({{"left", "x z"}, {"right", "z"}}) +
    table("[[load]]", R"(at = "left"; moment = -0.14926)") + table("[[load]]", R"(at = "right"; moment = 0.14926)") +
    monitor("mid", "beam:0.5", "z") + path("step = 0.1; stop = { lambda = [-1.0, 5.72] }") +
    member("beam", "left", "right", "euler-bernoulli", 24, "", "steel") +
    wall("floor",
         R"(side = "below"; profile = { type = "parabola", apex = [14.0515, -0.57259], curvature = -0.00027045 })");

}  // namespace

// The part is shorter than an element as it begins, and its nodes bear no more than round-off: it was told to lift off.
TEST(CurvedParts, StayWherePressureIsSmallerThanTheRoundOffOfForces) {
  for (const std::string elements : {"24", "48"}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(beam_on_a_flat_hill, {"member.beam.elements=" + elements});
    EXPECT_EQ(test::events_of(traced, EventKind::contact_opens).size(), 0U);
    EXPECT_EQ(test::events_of(traced, EventKind::contact_spreads).size(), 1U);
    test::expect_whole(traced);
  }
}

// The same on an arc with a force in the middle, which the part hands on to the two nodes beside it: what it adds to
// their forces is 10⁶ times what the pressure makes of them.
TEST(CurvedParts, StayUnderALoadThatTheyHandOn) {
  const test::TracedDeck traced(R"toml(
title = "a simple beam on an arc under a force and end moments"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.74025, height = 0.106828 }
point = { left = [0.0, 0.0], right = [6.26568, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "left", moment = -0.060924 }, { at = "right", moment = 0.060924 }, { at = "beam:0.5", force = [0.0, -0.058321] }]
path = { step = 0.1, stop = { lambda = [-1.0, 9.0] } }
member.beam = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 52 }
[[wall]]
name = "floor"
side = "below"
profile = { type = "circle", centre = [2.24117, -49.970877], radius = 49.72822 }
)toml");
  EXPECT_EQ(test::events_of(traced, EventKind::contact_opens).size(), 0U);
  EXPECT_EQ(traced.record().branches.back().end->reason, EndReason::stop);
}

// At 16.3 a point of the spline pushes with a force of its own. It lies inside the part, whose pressure is the same on
// both sides; the forces of the nodes beside it scatter, and the pressure at the end that they tell came to zero.
TEST(CurvedParts, StayAcrossAPointOfASplineThatPushes) {
  for (const std::string elements : {"40", "80"}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(R"toml(
title = "a guided beam on a wavy floor"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.42243, height = 0.30706 }
point = { left = [0.0, 0.0], right = [32.59031, 0.0] }
support = { left = ["x", "z", "rotation"], right = ["z", "rotation"] }
load = [{ on = "beam", distributed = [0.0, -0.00220234] }]
path = { step = 0.1, stop = { lambda = [-1.0, 9.0] } }
member.beam = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 40 }
[[wall]]
name = "floor"
side = "below"
profile = { type = "spline", x = [-8.147578, 0.0, 8.147578, 16.295155, 24.442734, 32.590312, 40.73789], z = [-0.623046, -0.521258, -0.692849, -0.688117, -0.577003, -0.519453, -0.642177] }
)toml",
                                  {"member.beam.elements=" + elements});
    EXPECT_EQ(test::events_of(traced, EventKind::contact_opens).size(), 0U);
    EXPECT_EQ(test::events_of(traced, EventKind::contact_spreads).size(), 1U);
    test::expect_whole(traced);
  }
}

// Just beyond a point of a spline that pushes, 0.0135 of a length of 34.3, the wall would pull: the touch becomes two,
// one at that point. An arch as long to both sides would enter the wall there, and the branch ended. The loads are own
// shooting's, of the elastica with extension (Dormand-Prince of eighth order, tolerance 10⁻¹²): a touch and one without
// curvature; two touches and one without force between them.
TEST(CurvedParts, TouchesSpreadBesideAPointOfASplineThatPushesSlow) {
  for (const auto& [elements, tolerance] : {std::pair("26", 2e-6), std::pair("52", 2e-8)})
    for (const std::string step : {"0.05", "0.0125"}) {
      SCOPED_TRACE(fmt::format("{} elements, steps of {}", elements, step));
      const test::TracedDeck traced(R"toml(
title = "a pinned column under a wavy ceiling"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.543559467438243, height = 0.28941142817075316 }
point = { left = [0.0, 0.0], right = [34.30214712285035, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "right", force = [-0.19341461030843976, 0.0] }]
path = { step = 0.05, stop = { lambda = [-1.0, 8.0] } }
member.column = { from = "left", to = "right", theory = "elastica", material = "steel", section = "s", elements = 26 }
[[wall]]
name = "upper"
side = "above"
profile = { type = "spline", x = [-8.575536780712588, 4.287768390356293, 17.15107356142517, 30.014378732494052, 42.87768390356293], z = [3.7738395386721852, 3.5310491335423015, 3.4178242573363, 3.894299068590671, 3.8372088635198254] }
)toml",
                                    {fmt::format("member.column.elements={}", elements), "path.step=" + step});
      EXPECT_NEAR(test::event_of(traced, EventKind::contact_splits, 2).lambda, 4.5420029018, tolerance);
      EXPECT_NEAR(test::event_of(traced, EventKind::contact_opens).lambda, 6.6144000261, tolerance);
      test::expect_whole(traced);
    }
}

}  // namespace arcwall::curved_parts_test
