// Values that are landed on right behind a change of contact, before the first point of the active set behind it: the
// change stays where it is, the value is met, and what is told there is an equilibrium. Four decks where the first
// point is a finite stretch away. What is compared with is the same run without the value.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::values_behind_changes_test {
namespace {

// A part that a straight wall presses comes to where the stress-free axis has no pressure for it, and lifts off there.
constexpr const char* lifts_off = R"toml(
title = "a column that lies down on a wall under a load across"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.18, height = 0.0675 }
point = { left = [0.0, 0.0], right = [8.5, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "right", force = [-0.0132, 0.0] }, { at = "column:0.2", force = [0.0, -0.00116] }]
path = { step = 0.05, jumps = false, stop = { lambda = [-1.0, 4.96] } }
member.column = { from = "left", to = "right", theory = "elastica", material = "steel", section = "s", elements = 20, imperfection = [{ shape = "sine", amplitude = 0.0034, waves = 2 }, { shape = "sine", amplitude = 0.0009, waves = 3 }] }
wall = [{ name = "lower", side = "below", profile = { type = "flat", z = -0.42 } }]
)toml";

// A touch spreads beside a point load, which the part takes in later.
constexpr const char* spreads_beside_load = R"toml(
title = "a column with a load across that touches a wall beside that"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.16, height = 0.1 }
point = { left = [0.0, 0.0], right = [3.26, 0.0] }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "right", force = [-0.27, 0.0] }, { at = "column:0.5", force = [0.0, -0.0316], constant = true }]
path = { step = 0.05, jumps = false, stop = { lambda = [-1.0, 5.57] } }
member.column = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 16, imperfection = [{ shape = "sine", amplitude = 0.0077, waves = 1 }, { shape = "sine", amplitude = 0.0005, waves = 2 }, { shape = "sine", amplitude = 0.0004, waves = 3 }] }
wall = [{ name = "lower", side = "below", profile = { type = "flat", z = -0.203 } }]
)toml";

// On a curved wall a new part of half the first length has pressures that round-off hides.
constexpr const char* spreads_in_a_hollow = R"toml(
title = "a propped beam on a parabola"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.13, height = 0.075 }
point = { left = [0.0, 0.0], right = [2.2, 0.0] }
support = { left = ["x", "z", "rotation"], right = ["z"] }
load = [{ at = "right", moment = 0.0632 }, { at = "beam:0.5", force = [0.0, -0.1426] }]
path = { step = 0.1, jumps = false, stop = { lambda = [-1.0, 5.58] } }
member.beam = { from = "left", to = "right", theory = "elastica", material = "steel", section = "s", elements = 52 }
wall = [{ name = "lower", side = "below", profile = { type = "parabola", apex = [1.257, -0.2224], curvature = 0.0249 } }]
)toml";

// An arch that has snapped comes to lie along a floor as λ falls, and λ turns there: on the active set that ends no
// value is ahead.
constexpr const char* spreads_at_a_turn = R"toml(
title = "an arch above a floor"
material.m = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { l = [0.0, 0.0], r = [2.0, 0.0] }
support = { l = ["x", "z"], r = ["x", "z"] }
load = [{ on = "arch", distributed = [0.0, -1.0] }]
path = { step = 0.01, jumps = false, stop = { lambda = [-0.05, 0.2] } }
member.arch = { from = "l", to = "r", sine = { rise = 0.1, waves = 1 }, theory = "elastica", material = "m", section = "s", elements = 40 }
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 } }]
)toml";

std::string kinds_of(const Record& record) {
  std::string kinds;
  for (const RecordEvent& event : record.events) kinds += std::string(to_text(event.kind)) + " ";
  return kinds;
}

// Values at parts of the way from an event to the next point, the least of them `nearest`.
void expect_events_stay(const char* deck, EventKind kind, double nearest = 1e-3) {
  const test::TracedDeck whole(deck);
  const RecordEvent& event = test::event_of(whole, kind);
  const std::vector<RecordPoint>& points = whole.record().points;
  const double from = event.lambda, to = points.at(static_cast<std::size_t>(event.step) + 1).lambda;
  ASSERT_GT(to, from);
  for (const double part : {nearest, 0.03, 0.1, 0.25, 0.5, 0.9}) {
    SCOPED_TRACE("part " + round_trip(part));
    const double value = from + part * (to - from);
    const test::TracedDeck traced(deck, {"path.output_at.lambda=[" + round_trip(value) + "]"});
    const Record& record = traced.record();
    ASSERT_EQ(kinds_of(record), kinds_of(whole.record()));
    for (std::size_t i = 0; i < record.events.size(); ++i)
      EXPECT_NEAR(record.events[i].lambda, whole.record().events[i].lambda, 1e-9) << "event " << i;
    const double arc = test::event_of(traced, kind).arc;
    const auto is_met = [&](const RecordPoint& point) {
      return point.arc >= arc && std::abs(point.lambda - value) <= 1e-11;
    };
    EXPECT_EQ(std::count_if(record.points.begin(), record.points.end(), is_met), 1);
    test::expect_verified(traced);
  }
}

}  // namespace

TEST(ValuesBehindChanges, LeaveTheLiftingOfAPartWhereItIs) { expect_events_stay(lifts_off, EventKind::contact_splits); }

TEST(ValuesBehindChanges, LeaveASpreadingBesideALoadWhereItIs) {
  expect_events_stay(spreads_beside_load, EventKind::contact_spreads);
}

TEST(ValuesBehindChanges, LeaveASpreadingInAHollowWhereItIs) {
  expect_events_stay(spreads_in_a_hollow, EventKind::contact_spreads);
}

// Nearer ones are met, too, but round-off hides the forces of a part that is so short.
TEST(ValuesBehindChanges, AreMetBehindASpreadingAtWhichTheLoadTurnsSlow) {
  expect_events_stay(spreads_at_a_turn, EventKind::contact_spreads, 0.03);
}

}  // namespace arcwall::values_behind_changes_test
