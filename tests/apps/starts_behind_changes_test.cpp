// A path that begins just behind a change of contact, to which constant loads have grown: the change is at its start.
// Reference: the same structure under the same load in all, of which nothing is constant, so that its path leads
// through the change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall {

namespace {

// A cantilever that a uniform load presses up to a ceiling that bends away from it: its tip touches, the contact moves
// inside and spreads.
test::TracedDeck pressed_up(double constant, double last) {
  const std::string load =
      constant == 0.0 ? "" : fmt::format("{{ on = \"c\", distributed = [0.0, {}], constant = true }}, ", constant);
  return test::TracedDeck(fmt::format(R"toml(
title = "A strip under a ceiling"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 1e5, I = 1.0, height = 0.01 }}
point = {{ a = [0.0, 0.0], b = [1.0, 0.0] }}
support = {{ a = ["x", "z", "rotation"] }}
member.c = {{ from = "a", to = "b", theory = "elastica", elements = 16, material = "m", section = "s" }}
load = [{}{{ on = "c", distributed = [0.0, 1.0] }}]
wall = [{{ name = "ceiling", side = "above", profile = {{ type = "parabola", apex = [0.5, 0.05], curvature = 0.1 }} }}]
path = {{ step = 0.1, stop = {{ lambda = [-0.5, {}] }} }}
monitor = [{{ name = "z", at = "c:0.5", component = "z" }}]
)toml",
                                      load, last));
}

}  // namespace

TEST(StartsBehindChanges, WhereAContactHasJustSpread) {
  const double spreads_at = test::event_of(pressed_up(0.0, 10.0), EventKind::contact_spreads).lambda;
  for (const double beyond : {1e-6, 1e-5, 1e-4}) {
    SCOPED_TRACE(beyond);
    const double constant = spreads_at * (1.0 + beyond);
    const test::TracedDeck begun = pressed_up(constant, 3.0), whole = pressed_up(0.0, constant + 3.0);
    EXPECT_EQ(test::event_of(begun, EventKind::contact_spreads).lambda, 0.0);
    const RecordPoint &last = begun.record().points.back(), &expected = whole.record().points.back();
    EXPECT_EQ(last.lambda, 3.0);
    EXPECT_NEAR(last.monitors[0], expected.monitors[0], 1e-9);
    ASSERT_EQ(last.forces.size(), expected.forces.size());
    for (std::size_t i = 0; i < last.forces.size(); ++i)
      EXPECT_NEAR(last.forces[i].force, expected.forces[i].force, 1e-6);
    test::expect_whole(begun);
  }
}

}  // namespace arcwall
