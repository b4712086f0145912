// Monitors of walls: the force on one member or on its end, and where contact begins and ends, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::wall_monitors_test {

namespace {

using loading_test::expect_confirmed;
using test::said_of;
using test::TracedDeck;

std::string monitor(const std::string& name, const std::string& of, const std::string& component) {
  return fmt::format("[[monitor]]\nname = \"{}\"\n{}\ncomponent = \"{}\"\n", name, of, component);
}

double last(const TracedDeck& run, const std::string& name) {
  const auto& columns = run.record().columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return run.record().points.back().monitors[i];
  ADD_FAILURE() << "no monitor is called " << name;
  return 0.0;
}

void expect_in(const std::string& said, const std::string& part) {
  EXPECT_NE(said.find(part), std::string::npos) << said << "\n: " << part;
}

// Two cantilevers of EI = 1, of length 1 to the right and 2 to the left, whose tips, 0.01 and 0.0095 lower, a floor
// pushes up.
std::string two_cantilevers(const std::string& points, const std::string& monitors) {
  return fmt::format(R"toml(
title = "Two cantilevers on a floor"
material.m = {{ E = 12.0 }}
section.s = {{ shape = "rectangle", width = 1e3, height = 0.1 }}
point = {{ A = [0.0, 0.0], B = [1.0, -0.01], C = [-1.0, 0.0], D = [-3.0, -0.0095] }}
support = {{ A = ["x", "z", "rotation"], C = ["x", "z", "rotation"] }}
contact = {{ points = "{}" }}
path = {{ step = 0.1, output_at = {{ lambda = [0.2, 0.4, 0.6, 0.8] }}, stop = {{ lambda = [-1.0, 1.0] }} }}
[member]
short = {{ from = "A", to = "B", theory = "elastica", elements = 6, material = "m", section = "s" }}
long = {{ from = "C", to = "D", theory = "elastica", elements = 6, material = "m", section = "s" }}
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = -0.011 }}
motion = {{ z = 2e-3 }}
)toml",
                     points) +
         monitors;
}

const std::string forces = monitor("all", "wall = \"floor\"", "force-z") +
                           monitor("short", "wall = \"floor\"\nmember = \"short\"", "force-z") +
                           monitor("long", "wall = \"floor\"\nmember = \"long\"", "force-z") +
                           monitor("tip", "wall = \"floor\"\nat = \"B\"", "force-z") +
                           monitor("end", "wall = \"floor\"\nat = \"long:1\"", "force-z") +
                           monitor("clamp", "wall = \"floor\"\nat = \"long:0\"", "force-z");

// A heavy strip on a floor, EI = 1, whose right end is lifted by δ.
std::string lifted_strip(const std::string& points, int elements, const std::string& more = "") {
  return fmt::format(R"toml(
title = "A strip that is lifted off a floor"
material.m = {{ E = 12.0 }}
section.s = {{ shape = "rectangle", width = 1e3, height = 0.1 }}
point = {{ A = [0.0, 0.0], B = [4.0, 0.0] }}
support = {{ A = ["x"] }}
contact = {{ points = "{}" }}
load = [{{ on = "strip", distributed = [0.0, -0.024], constant = true }}]
prescribed = [{{ at = "B", z = 1e-3 }}]
path = {{ step = 0.05{}, stop = {{ lambda = [-1.0, 1.0] }} }}
member.strip = {{ from = "A", to = "B", theory = "elastica", elements = {}, material = "m", section = "s" }}
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = 0.0 }}
)toml",
                     points, more, elements) +
         monitor("first", "wall = \"floor\"\nmember = \"strip\"", "contact-start") +
         monitor("edge", "wall = \"floor\"\nmember = \"strip\"", "contact-end") +
         monitor("F", "at = \"B\"", "reaction-z");
}

}  // namespace

// 3 EI δ/L³ on each tip, to the square of the slopes, 1e-4.
TEST(WallMonitor, TellsWhatEachMemberBears) {
  for (const char* points : {"nodes", "moving"}) {
    SCOPED_TRACE(points);
    const TracedDeck run(two_cantilevers(points, forces));
    EXPECT_NEAR(last(run, "short"), 3e-3, 3e-4 * 3e-3);
    EXPECT_NEAR(last(run, "long"), 1.5e-3 / 8.0, 3e-4 * 1.5e-3 / 8.0);
    EXPECT_NEAR(last(run, "all"), last(run, "short") + last(run, "long"), 1e-15);
    EXPECT_EQ(last(run, "tip"), last(run, "short"));
    EXPECT_EQ(last(run, "end"), last(run, "long"));
    EXPECT_EQ(last(run, "clamp"), 0.0);
    for (const MonitorColumn& column : run.model().monitors())
      EXPECT_LE(check_gradient(*column.quantity, run.last()), 1e-6) << column.name;
    expect_confirmed(run);
  }
}

// The free length ℓ has neither slope nor moment at its left end: ℓ⁴ = 24 EI δ/q, and the lift is q ℓ/2.
TEST(WallMonitor, TellsWhereContactEnds) {
  for (const double delta : {0.25, 1.0}) {
    SCOPED_TRACE(delta);
    const double free = std::pow(24.0 * delta * 1e-3 / 0.024, 0.25);
    const TracedDeck run(deck::replaced(lifted_strip("moving", 16), "stop = { lambda = [-1.0, 1.0] }",
                                        fmt::format("stop = {{ lambda = [-1.0, {}] }}", delta)));
    EXPECT_NEAR(last(run, "edge"), 4.0 - free, 2e-5);
    EXPECT_NEAR(last(run, "edge-x"), 4.0 - free, 2e-5);
    EXPECT_NEAR(last(run, "first"), 0.0, 1e-12);
    EXPECT_NEAR(last(run, "F"), 0.5 * 0.024 * free, 1e-5 * 0.024);
    for (const MonitorColumn& column : run.model().monitors())
      if (column.name == "edge" || column.name == "edge-x") {
        EXPECT_LE(check_gradient(*column.quantity, run.last()), 1e-6) << column.name;
      }
    expect_confirmed(run);
  }
}

// With contact at nodes it is that of a node.
TEST(WallMonitor, TellsTheNodeAtWhichContactEnds) {
  const TracedDeck run(lifted_strip("nodes", 32));
  EXPECT_NEAR(last(run, "edge"), 3.0, 0.126);
  EXPECT_EQ(std::remainder(last(run, "edge"), 0.125), 0.0);
}

// A place that an edge passes is an event: at ℓ = ½ and ¾, δ = q ℓ⁴/24 EI.
TEST(WallMonitor, MakesAnEdgeThatPassesAPlaceAnEvent) {
  const TracedDeck run(lifted_strip("moving", 16, ", watch = { value = { edge = [3.5, 3.25] } }"));
  const auto events = events_of(run, EventKind::value_crossing);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[0].lambda, std::pow(0.5, 4), 1e-4);
  EXPECT_NEAR(events[1].lambda, std::pow(0.75, 4), 1e-4);
  expect_confirmed(run);
}

// Couples that keep the open point of a member where its gap is least are zero to round-off, and no wall exerts them.
TEST(WallMonitor, HasNoTurningPointsOfRoundOffWithoutContact) {
  const test::TracedDeck traced(R"toml(
title = "A card flicks past a reed and leaves it"
units = { length = "mm", force = "N" }
material.s = { E = 2.0e5 }
section.s = { shape = "rectangle", width = 5.0, height = 0.5 }
point = { p = [0.0, 8.0], e = [30.0, 0.0] }
support.p = ["x", "z", "rotation"]
path = { step = 0.05, watch = ["push"], stop = { lambda = [-0.1, 22.0] } }
member.s = { from = "p", to = "e", theory = "elastica", material = "s", section = "s", elements = 16 }
wall = [{ name = "cam", contact_surface = "axis", outline = { type = "circle", centre = [36.0, -1.5], radius = 2.0 }, motion = { x = -1.0 } }]
monitor = [{ name = "push", wall = "cam", component = "force-x", sign = -1 }]
)toml");
  const double left = test::event_of(traced, EventKind::contact_opens).lambda;
  for (const RecordEvent& event : test::events_of(traced, EventKind::turning_point)) EXPECT_LE(event.lambda, left);
  for (const RecordPoint& point : traced.record().points)
    if (point.lambda > left + 1e-9) {
      EXPECT_EQ(point.monitors.front(), 0.0);
    }
}

TEST(WallMonitor, IsInfiniteWithoutContact) {
  const TracedDeck run(
      deck::replaced(two_cantilevers("moving", monitor("e", "wall = \"floor\"\nmember = \"long\"", "contact-end")),
                     "z = -0.011 }\nmotion", "z = -1.0 }\nmotion"));
  EXPECT_EQ(last(run, "e"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(last(run, "e-x"), std::numeric_limits<double>::infinity());
  expect_confirmed(run);
}

TEST(WallMonitor, IsRefusedWhereThereIsNone) {
  const auto with = [](const std::string& of, const std::string& component) {
    return said_of(two_cantilevers("moving", monitor("m", of, component)));
  };
  expect_in(with("wall = \"floor\"\nat = \"long:0.5\"", "force-z"), "contact inside a member moves along it");
  expect_in(with("wall = \"floor\"\nat = \"long:1\"", "moment"), "give gap, force-x or force-z");
  expect_in(with("wall = \"floor\"", "contact-end"), "add `member`: the one that the wall touches");
  expect_in(with("member = \"long\"", "contact-end"), "a member as a whole has no contact-end");
  expect_in(with("at = \"B\"", "contact-end"), "belongs to a wall and a member");
  const std::string other =
      deck::replaced(two_cantilevers("moving", monitor("m", "wall = \"floor\"\nmember = \"long\"", "force-z")),
                     "side = \"below\"", "side = \"below\"\nmembers = [\"short\"]");
  expect_in(said_of(other), "does not stand in the way of \"long\"");
}

}  // namespace arcwall::wall_monitors_test
