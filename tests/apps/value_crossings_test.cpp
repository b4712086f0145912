// Values of λ and of monitors that are events when they are passed, and paths that end without contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::value_crossings_test {

namespace {

using loading_test::expect_confirmed;
using test::said_of;
using test::TracedDeck;

// The truss of the examples: P = EA w (w − h)(w − 2h)/L³, h = 0.5, L² = 25.25.
double load_of(double w) { return 1e5 * w * (w - 0.5) * (w - 1.0) / std::pow(25.25, 1.5); }

std::string truss(const std::string& path) {
  return deck::replaced(test::example("truss"), "step = 5.0", path + "\nstep = 5.0");
}

// Of the devices that come with the program.
std::string device(const std::string& name) {
  for (const ExampleDeck& deck : example_devices())
    if (deck.name == name) return std::string(deck.text);
  ADD_FAILURE() << "no device is called " << name;
  return {};
}

double monitor(const RecordEvent& event) { return event.monitors.at(0); }

void expect_in(const std::string& said, const std::string& part) {
  EXPECT_NE(said.find(part), std::string::npos) << said << "\n: " << part;
}

}  // namespace

TEST(ValueCrossing, IsWhereTheClosedFormHasIt) {
  const TracedDeck run(truss("watch = { zero = [\"lambda\"], value = { w = [0.05, 0.7], lambda = [20.0] } }"));
  std::vector<std::pair<std::string, double>> found;
  for (const RecordEvent& event : events_of(run, EventKind::value_crossing)) {
    found.emplace_back(event.monitor.value(), monitor(event));
    EXPECT_NEAR(event.lambda, load_of(monitor(event)), 1e-10);
    EXPECT_LE(event.lambda_uncertainty, 1e-13);
    if (event.monitor == "w") {
      EXPECT_NEAR(monitor(event), event.value.value(), 1e-13);
    }
    if (event.monitor == "lambda") {
      EXPECT_NEAR(event.lambda, event.value.value(), 1e-11);
    }
  }
  ASSERT_EQ(found.size(), 7U);
  const std::vector<std::string> names{"w", "lambda", "lambda", "lambda", "w", "lambda", "lambda"};
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].first, names[i]) << i;
  EXPECT_NEAR(found[3].second, 0.5, 1e-12);  // λ = 0 halfway and, snapped through, at 2h
  EXPECT_NEAR(found[5].second, 1.0, 1e-12);
  expect_confirmed(run);
}

TEST(ValueCrossing, DoesNotDependOnSteps) {
  for (const char* step : {"step = 1.25", "step = 5.0", "step = 20.0"})
    for (const char* method : {"spherical", "riks", "pseudo-arclength"}) {
      SCOPED_TRACE(std::string(step) + " " + method);
      const TracedDeck run(deck::replaced(truss("watch = { zero = [\"lambda\"] }"), "step = 5.0", step),
                           {fmt::format("path.method='{}'", method)});
      const auto events = events_of(run, EventKind::value_crossing);
      ASSERT_EQ(events.size(), 2U);
      EXPECT_NEAR(monitor(events[0]), 0.5, 1e-12);
      EXPECT_NEAR(monitor(events[1]), 1.0, 1e-12);
    }
}

// Two values at one point are two events.
TEST(ValueCrossing, ReportsAllThatArePassedAtOnePoint) {
  const TracedDeck run(truss("watch = { zero = [\"lambda\"], value = { w = [0.5] } }"));
  std::vector<std::string> names;
  for (const RecordEvent& event : events_of(run, EventKind::value_crossing))
    if (std::abs(monitor(event) - 0.5) < 1e-9) names.push_back(event.monitor.value());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"lambda", "w"}));
  expect_confirmed(run);
}

TEST(ValueCrossing, StandsInTheFiles) {
  const TracedDeck run(truss("watch = { value = { w = [0.7] } }"));
  const auto json = events_json(run.record());
  const auto is_it = [](const auto& event) { return event["kind"] == "value-crossing"; };
  const auto found = std::find_if(json["events"].begin(), json["events"].end(), is_it);
  ASSERT_NE(found, json["events"].end());
  EXPECT_EQ((*found)["monitor"], "w");
  EXPECT_EQ((*found)["value"], 0.7);
  expect_in(events_text(run.record(), {}), "w = 0.7");
}

TEST(ValueCrossing, MayEndAPath) {
  const TracedDeck run(truss("watch = { zero = [\"lambda\"] }"), {"path.stop.event='value-crossing'"});
  EXPECT_NEAR(run.record().points.back().monitors[0], 0.5, 1e-12);
}

// A watched monitor may turn, too.
TEST(ValueCrossing, StandsBesideTurningPoints) {
  const TracedDeck run(truss("watch = { turning = [\"w\"], zero = [\"w\"] }"));
  EXPECT_TRUE(events_of(run, EventKind::value_crossing).empty()) << "where a path begins no value is passed";
}

TEST(ValueCrossing, IsRefusedWhereNothingIsPassed) {
  expect_in(said_of(truss("watch = { zero = [\"v\"] }")), "path.watch.zero");
  expect_in(said_of(truss("watch = { zero = [\"v\"] }")), "is neither lambda nor a monitor");
  expect_in(said_of(truss("watch = { zeros = [\"w\"] }")), "did you mean zero?");
  expect_in(said_of(truss("watch = { value = { w = \"a\" } }")), "path.watch.value.w");
  expect_in(said_of(deck::replaced(test::example("truss"), "[path.stop]", "[path.stop]\nevent = \"value-crossing\"")),
            "add watch = { zero = [\"MONITOR\"] }");
}

// The push of a snap-fit is zero all along the top of its catch. The nose comes to it where the rounding, of radius 0.3
// between slopes of 1/2 and 0, ends: 0.3 tan(½ atan ½) to the right of the corner, which λ moves to the left.
TEST(ValueCrossing, IsWhereAForceVanishesForGood) {
  const std::string deck = device("snap-fit") + "\n[[monitor]]\nname = \"nose\"\nat = \"nose\"\ncomponent = \"x\"\n";
  for (const char* step : {"0.05", "0.2"}) {
    SCOPED_TRACE(step);
    const TracedDeck run(deck,
                         {"path.watch={zero=['push']}", "path.jumps=false", fmt::format("path.max_step={}", step)});
    const auto events = events_of(run, EventKind::value_crossing);
    ASSERT_EQ(events.size(), 2U);  // it pulls on the steep flank until it leaves that at 26.6
    EXPECT_NEAR(events[1].lambda, 6.6, 1e-9);
    EXPECT_NEAR(events[0].monitors[1], 1.2, 1e-9);
    const double rounding = 0.3 * std::tan(0.5 * std::atan(0.5));
    EXPECT_NEAR(events[0].lambda, 3.9 + rounding - events[0].monitors[2], 1e-8);
    EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
    expect_confirmed(run);
  }
}

// Before it touches a guidewire carries nothing but round-off, which passes no value.
TEST(ValueCrossing, IsNotMadeByRoundOff) {
  const TracedDeck run(device("guidewire"),
                       {"path.watch={zero=['push', 'tip']}", "path.jumps=false", "path.stop.lambda=[-1.0, 40.0]"});
  EXPECT_TRUE(events_of(run, EventKind::value_crossing).empty());
  expect_confirmed(run);
}

// A strip over a floor, bent down by a moment at its right end, which then is taken back. It touches, and leaves.
std::string strip_that_leaves(const std::string& points, const std::string& stop) {
  return fmt::format(R"toml(
title = "A strip that touches and leaves"
material.m = {{ E = 1.2e5 }}
section.s = {{ shape = "rectangle", width = 0.1, height = 0.1 }}
point = {{ a = [0.0, 0.0], b = [10.0, 0.0] }}
support = {{ a = ["x", "z"], b = ["z"] }}
member.beam = {{ from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 10 }}
load = [{{ at = "beam:0.5", force = [0.0, -1e-3] }}]
contact = {{ points = "{}" }}
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = {{ type = "flat", z = -0.005 }}
motion = {{ z = -0.01 }}
[path]
step = 0.05
output_at = {{ lambda = [0.05, 0.1, 0.15, 0.2] }}
stop = {{ lambda = [-1.0, 20.0]{} }}
)toml",
                     points, stop);
}

// The deflection under the force is 1e-3 L³/(48 EI) = 0.0208 λ, to 10⁻⁵ by its slopes, and the floor is 0.005 + 0.01 λ
// below: they meet at λ = 0.46154. From there on contact bears the rest: it never leaves.
TEST(StopWithoutContact, DoesNotEndAPathThatHasHadNone) {
  for (const char* points : {"nodes", "moving"}) {
    SCOPED_TRACE(points);
    const TracedDeck run(strip_that_leaves(points, ", contacts = 0"));
    EXPECT_NEAR(run.record().points.back().lambda, 20.0, 1e-9);
    EXPECT_NEAR(event_of(run, EventKind::contact_closes).lambda, 0.005 / (1.0 / 48.0 - 0.01), 1e-4);
  }
}

// A floor that sinks faster than the strip follows: where it is pressed from the start it is left at λ = 0.0025/0.0292.
TEST(StopWithoutContact, EndsWhereTheLastContactOpens) {
  for (const char* points : {"nodes", "moving"}) {
    SCOPED_TRACE(points);
    std::string deck = strip_that_leaves(points, ", contacts = 0");
    deck = deck::replaced(deck, "force = [0.0, -1e-3] }", "force = [0.0, -1e-3], constant = true }");
    deck = deck::replaced(deck, "motion = { z = -0.01 }", "motion = { z = -0.05 }");
    const TracedDeck run(deck);
    const RecordPoint& end = run.record().points.back();
    EXPECT_EQ(end.contacts, 0);
    EXPECT_NEAR(end.lambda, (1.0 / 48.0 - 0.005) / 0.05, 1e-5);
    ASSERT_TRUE(run.record().branches[0].end);
    EXPECT_EQ(run.record().branches[0].end->reason, EndReason::stop);
    EXPECT_EQ(run.record().branches[0].end->detail, "contacts = 0");
    expect_confirmed(run);
  }
}

}  // namespace arcwall::value_crossings_test
