// A clamped strip whose stress-free shape is a full sine wave of amplitude L/1000, pushed up to a flat ceiling by a
// load at its quarter. As its tip lies down, the strip would have to be pulled to lie on the ceiling beside it: so it
// arches, and touches at its tip and at a place that moves inside. References: extensible elastica of EI = L = 1, EA =
// 9e4, shot from the clamp with an 8th-order method (1e-12) for z at the tip and no moment there, and for the angle
// there or z and the angle at the second contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall {

TEST(WavyStrip, ArchesBesideItsTipAsThatLiesDownSlow) {
  for (const int elements : {8, 12, 24, 48}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(fmt::format(R"toml(
title = "A wavy strip whose tip lies down"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 9e4, I = 1.0 }}
point = {{ a = [0.0, 0.0], b = [1.0, 0.0] }}
support = {{ a = ["x", "z", "rotation"] }}
member.c = {{ from = "a", to = "b", theory = "euler-bernoulli", elements = {}, material = "m", section = "s", imperfection = {{ shape = "sine", amplitude = 0.001, waves = 2 }} }}
load = [{{ at = "c:0.25", force = [0.0, 3.0] }}]
wall = [{{ name = "ceiling", side = "above", contact_surface = "axis", profile = {{ type = "flat", z = 0.03 }} }}]
path = {{ step = 0.1, stop = {{ lambda = [-0.5, 3.0] }} }}
)toml",
                                              elements));
    const double error = elements < 24 ? 3e-7 : 1e-8;
    const auto touches = test::events_of(traced, EventKind::contact_closes);
    const auto splits = test::events_of(traced, EventKind::contact_splits);
    ASSERT_EQ(touches.size(), 1U);
    ASSERT_EQ(splits.size(), 1U);
    EXPECT_NEAR(touches[0].lambda, 0.3493005164566812, error);
    EXPECT_NEAR(splits[0].lambda, 1.4630017415429288, error);
    const RecordPoint& last = traced.record().points.back();
    EXPECT_EQ(last.lambda, 3.0);
    ASSERT_EQ(last.forces.size(), 2U);
    EXPECT_NEAR(last.forces[0].label.fraction, 0.5293019737487836, error);
    EXPECT_NEAR(last.forces[0].force, 1.7095114928973016, 10.0 * error);
    EXPECT_NEAR(last.forces[1].label.fraction, 1.0, 0.0);
    EXPECT_NEAR(last.forces[1].force, 0.08890378, 10.0 * error);
    test::expect_whole(traced);
  }
}

// A slender strip (EA L²/EI = 4e7) whose tip slides up a sloping ceiling, until it is tangent to that and the contact
// passes inside. What round-off makes of forces is a great scale then, and no measure of the error of a mesh: an arch
// whose tip the ceiling pulls with 0.7 % of the load is none. References: shot from the clamp as above.
TEST(WavyStrip, IsNotPulledAtItsTipSlow) {
  for (const int elements : {24, 48}) {
    SCOPED_TRACE(elements);
    const test::TracedDeck traced(fmt::format(R"toml(
title = "A slender strip whose tip slides along a ceiling"
material.m = {{ E = 1.0 }}
section.s = {{ shape = "general", A = 7.3e6, I = 1.0, height = 0.0045 }}
point = {{ a = [0.0, 0.0], b = [2.26, 0.0] }}
support = {{ a = ["x", "z", "rotation"] }}
member.c = {{ from = "a", to = "b", theory = "elastica", elements = {}, material = "m", section = "s", imperfection = {{ shape = "sine", amplitude = 0.00226, waves = 1 }} }}
load = [{{ at = "c:0.5833333333333334", force = [0.0, 0.837] }}]
wall = [{{ name = "ceiling", side = "above", profile = {{ type = "line", z = 0.226, slope = 0.0385 }} }}]
path = {{ step = 0.01, stop = {{ lambda = [-0.5, 3.0] }} }}
monitor = [{{ name = "z", at = "c:0.5833333333333334", component = "z" }}]
)toml",
                                              elements));
    EXPECT_NEAR(test::event_of(traced, EventKind::contact_transfers).lambda, 1.107500233895, 1e-10);
    EXPECT_TRUE(test::events_of(traced, EventKind::contact_spreads).empty());
    const RecordPoint& last = traced.record().points.back();
    EXPECT_EQ(last.lambda, 3.0);
    EXPECT_NEAR(last.monitors[0], 0.263196642899, 1e-10);
    ASSERT_EQ(last.forces.size(), 1U);
    EXPECT_NEAR(last.forces[0].label.fraction, 0.733175937614, 1e-10);
    EXPECT_NEAR(last.forces[0].force, 1.537014266091, 1e-9);
    test::expect_whole(traced);
  }
}

}  // namespace arcwall
