// Where one wall comes to a place that another one holds, the force passes over at constant load.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::force_exchange_test {

using test::TracedDeck;

// A weight of 100 on a spring of 10 lies on a fixed stop at −1: the stop bears 100 − 10 = 90. A stop that rises from
// −2 takes that over at λ = 1 and lifts the weight: z = λ − 2, B = 100 + 10 z. Another one from −2 − e comes to
// nothing.
TEST(ForceExchange, PassesFromAFixedStopToOneThatRises) {
  const TracedDeck traced(R"toml(
title = "a weight on a stop, and a stop that rises"
point = { a = [0.0, 0.0], b = [100.0, 0.0] }
material.soft = { E = 1.0 }
section.s = { shape = "general", A = 1.0e-9, I = 1.0 }
support = { a = ["x", "z"], b = ["x"] }
member.l = { from = "a", to = "b", theory = "truss", material = "soft", section = "s", elements = 1 }
spring = [{ at = "b", stiffness = { z = 10.0 } }]
load = [{ at = "b", force = [0.0, -100.0], constant = true }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.9] } }
wall = [{ name = "fixed", side = "below", contact_surface = "axis", profile = { type = "flat", z = -1.0 } },
 { name = "riser", side = "below", contact_surface = "axis", profile = { type = "flat", z = -2.0 }, motion = { z = 1.0 } }]
monitor = [{ name = "tip", at = "b", component = "z" }, { name = "A", wall = "fixed", component = "force-z" }, { name = "B", wall = "riser", component = "force-z" }]
)toml");
  const RecordEvent& closes = test::event_of(traced, EventKind::contact_closes);
  const RecordEvent& opens = test::event_of(traced, EventKind::contact_opens);
  EXPECT_NEAR(closes.lambda, 1.0, 1e-12);
  EXPECT_NEAR(opens.lambda, 1.0, 1e-12);
  EXPECT_EQ(closes.contacts.front().label.wall, "riser");
  EXPECT_EQ(opens.contacts.front().label.wall, "fixed");
  for (const RecordPoint& point : traced.record().points) {
    const double z = std::max(-1.0, point.lambda - 2.0), force = 100.0 + 10.0 * z;
    EXPECT_NEAR(point.monitors[0], z, 1e-10);
    EXPECT_NEAR(point.monitors[1] + point.monitors[2], force, 1e-8);
    if (point.lambda != closes.lambda) {
      EXPECT_NEAR(point.lambda < 1.0 ? point.monitors[2] : point.monitors[1], 0.0, 1e-12);
    }
  }
  EXPECT_EQ(traced.record().branches.front().end->reason, EndReason::stop);
  test::expect_whole(traced);
}

// Half a pipe of weight w is jacked up from its bed by v in the plane of symmetry: own shooting of the extensible
// elastica with the lift-off length as an unknown has the force 26.927 for v = 0.3. Contact is at nodes.
TEST(ForceExchange, LetsAJackTakeAPipeFromItsBed) {
  const TracedDeck traced(R"toml(
title = "half a pipe on its bed, and a jack"
material.steel = { E = 2.1e8 }
section.pipe = { shape = "tube", radius = 0.15, thickness = 0.015 }
point = { a = [0.0, 0.0], m = [60.0, 0.0] }
support = { a = ["x", "z", "rotation"], m = "symmetry-x" }
path = { step = 0.01, stop = { lambda = [-1.0, 1.0] } }
contact.points = "nodes"
load = [{ on = "w", distributed = [0.0, -1.5], constant = true }]
member.w = { from = "a", to = "m", theory = "elastica", material = "steel", section = "pipe", elements = 60 }
wall = [{ name = "bed", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 } },
 { name = "jack", contact_surface = "axis", outline = { type = "circle", centre = [60.0, -1.001], radius = 1.0 }, motion = { z = 0.301 } }]
monitor = [{ name = "lift", at = "m", component = "z" }, { name = "F", wall = "jack", component = "force-z" }]
)toml");
  const RecordPoint& last = traced.record().points.back();
  ASSERT_EQ(last.lambda, 1.0);
  EXPECT_NEAR(last.monitors[0], 0.3, 1e-9);
  EXPECT_NEAR(last.monitors[1], 26.927, 0.01 * 26.927);
}

}  // namespace arcwall::force_exchange_test
