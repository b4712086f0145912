// The joint of two members in line touches a wall as one contact, whatever the mesh and the steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::joint_touches_test {
namespace {

// Two arcs that meet at the crown of a leaf spring, which hangs 0.6 below its ends and is pressed on a floor.
std::string leaf_spring(int elements, double step) {
  return fmt::format(R"toml(
title = "A leaf spring of two members, pressed on a floor at their joint"
material.steel = {{ E = 2.1e4 }}
section.s = {{ shape = "rectangle", width = 1.0, height = 0.3 }}
point = {{ left = [0.0, 0.0], crown = [6.6, -0.6], right = [13.2, 0.0] }}
support = {{ left = ["x", "z"], right = ["z"] }}
load = [{{ at = "crown", force = [0.0, -0.4] }}]
monitor = [{{ name = "down", at = "crown", component = "z", sign = -1 }}]
path = {{ step = {}, stop = {{ lambda = [-1.0, 4.0] }} }}
wall = [{{ name = "floor", side = "below", profile = {{ type = "flat", z = -1.1 }} }}]
[member]
west = {{ from = "left", to = "crown", via = [3.3, -0.45], theory = "euler-bernoulli", material = "steel", section = "s", elements = {} }}
east = {{ from = "crown", to = "right", via = [9.9, -0.45], theory = "euler-bernoulli", material = "steel", section = "s", elements = {} }}
)toml",
                     step, elements, elements);
}

}  // namespace

// By symmetry the joint does not turn. Its face lies half the height of 0.3 below the axis, across an arc that comes in
// by the angle of the tangent and the chord: 2.3e-8 less.
TEST(JointTouches, AsOneContactSlow) {
  const double tangent = std::atan(-0.15 / 3.3) + std::atan(-0.6 / 6.6) - std::atan(-0.45 / 3.3);
  const double way = 1.1 - 0.6 - 0.15 * std::cos(tangent);
  for (const int elements : {16, 20, 32, 40})
    for (const double step : {0.1, 0.025}) {
      SCOPED_TRACE(fmt::format("{} elements, step {}", elements, step));
      const test::TracedDeck traced(leaf_spring(elements, step));
      const Record& record = traced.record();
      ASSERT_EQ(record.events.size(), 3U);
      const RecordEvent& closes = record.events[1];
      EXPECT_EQ(closes.kind, EventKind::contact_closes);
      EXPECT_NEAR(closes.monitors.front(), way, 1e-10);
      ASSERT_EQ(closes.contacts.size(), 1U);
      EXPECT_EQ(closes.contacts.front().label.member, "west");
      EXPECT_EQ(record.events[2].kind, EventKind::end);
      test::expect_verified(traced);
    }
}

// A column that has buckled so far that it runs backwards along a roof: the contact comes to the joint of its two
// members from the one that bears no load, and passes to the other. Reference: both members shot from end to end with
// an 8th-order method (1e-12), extensible elastica, with a force at the joint, where the axis has turned by π and is
// half the height below the roof.
TEST(JointTouches, WhereTheMembersRunBackwardsSlow) {
  for (const int elements : {24, 48}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(fmt::format(R"toml(
title = "Contact passes a joint that has turned over"
material.m = {{ E = 0.56 }}
section.s = {{ shape = "general", A = 1.25, I = 1.0, height = 0.4 }}
point = {{ a = [0.0, 0.0], j = [25.8, 0.0], b = [41.0, 0.0] }}
support = {{ a = ["x", "z"], b = ["z"] }}
load = [{{ at = "b", force = [-0.003, 0.0] }}, {{ at = "b", force = [-0.0033, 0.0], constant = true }}, {{ on = "c", distributed = [0.0, -0.000137], constant = true }}]
wall = [{{ name = "roof", side = "above", profile = {{ type = "flat", z = 1.23 }} }}]
path = {{ step = 0.1, stop = {{ lambda = [-0.5, 3.0] }} }}
monitor = [{{ name = "x", at = "j", component = "x" }}]
member.c = {{ from = "a", to = "j", theory = "elastica", elements = {}, material = "m", section = "s" }}
member.d = {{ from = "j", to = "b", theory = "elastica", elements = {}, material = "m", section = "s" }}
)toml",
                                              elements, elements));
    const RecordEvent& passes = test::event_of(traced, EventKind::contact_transfers);
    const double error = elements == 24 ? 1e-6 : 2.5e-7;  // of stocky members: with the square of the elements' length
    EXPECT_NEAR(passes.lambda, 2.59473151415517, error);
    EXPECT_NEAR(passes.monitors[0], -25.39227293634156, 100.0 * error);
    const auto& points = traced.record().points;
    const auto is_there = [&](const RecordPoint& point) { return point.lambda == passes.lambda; };
    const auto at = std::find_if(points.begin(), points.end(), is_there);
    ASSERT_NE(at, points.end());
    ASSERT_EQ(at->forces.size(), 1U);
    EXPECT_NEAR(at->forces[0].force, 0.00937462082134, error);
    EXPECT_EQ(traced.record().points.back().lambda, 3.0);
    test::expect_verified(traced);
  }
}

}  // namespace arcwall::joint_touches_test
