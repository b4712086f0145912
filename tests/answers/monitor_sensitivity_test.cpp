// Derivatives of monitors along events: the force where λ is a movement. Against closed forms, and against decks that
// are run again with other values of a number.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "answers/event_curve.hpp"
#include "model/deck/reader.hpp"
#include "model/event_names.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/model/deck/sample_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::monitor_sensitivity_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

std::size_t column(const TracedDeck& run, const std::string& name) {
  const auto& columns = run.record().columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return i;
  ADD_FAILURE() << "no monitor is called " << name;
  return 0;
}

double rate(const TracedDeck& run, const RecordEvent& event, std::size_t key, const std::string& name) {
  return event.sensitivity.at(key).rates.at(column(run, name)).value();
}

// The truss of the examples under a load, and pushed by its top.
const std::string keys = "path.sensitivity=['material.bar.E', 'point.top.1']";

std::string pushed_truss(const std::string& path) {
  std::string deck = deck::replaced(test::example("truss"), "[[load]]\nat = \"top\"\nforce = [0.0, -1.0]",
                                    "[[prescribed]]\nat = \"top\"\nz = -1.0");
  deck = deck::replaced(deck, "step = 5.0", path + "\nstep = 0.02");
  return deck + "\n[[monitor]]\nname = \"F\"\nat = \"top\"\ncomponent = \"reaction-z\"\nsign = -1\n";
}

constexpr double EA = 1e5, h = 0.5, b = 5.0;

double force_at(double w, double rise) {
  return EA * w * (w - rise) * (w - 2.0 * rise) / std::pow(b * b + rise * rise, 1.5);
}

// ∂F/∂h at fixed w.
double force_by_rise(double w, double rise) {
  const double L2 = b * b + rise * rise;
  const double of_rise = EA * w * (-(w - 2.0 * rise) - 2.0 * (w - rise)) / std::pow(L2, 1.5);
  return of_rise - 3.0 * rise / L2 * force_at(w, rise);
}

}  // namespace

// w = h (1 ∓ 1/√3) at the limit points, whatever E.
TEST(MonitorSensitivity, OfALimitPointIsThatOfItsClosedForm) {
  const TracedDeck run(test::example("truss"), {keys});
  for (const int number : {1, 2}) {
    SCOPED_TRACE(number);
    const RecordEvent& limit = event_of(run, EventKind::limit_point, number);
    const double expected = 1.0 + (number == 1 ? -1.0 : 1.0) / std::sqrt(3.0);
    EXPECT_NEAR(rate(run, limit, 0, "w") * EA, 0.0, 1e-7);
    EXPECT_NEAR(rate(run, limit, 1, "w"), expected, 1e-7);
  }
}

// λ is the way of the top. Its force is greatest at w = h (1 − 1/√3): 2 EA h³/(3 √3 L³), which goes with E and by h
// with 3/h − 3h/L².
TEST(MonitorSensitivity, OfTheGreatestForceIsThatOfItsClosedForm) {
  const TracedDeck run(pushed_truss("watch = [\"F\"]"), {keys});
  const RecordEvent& most = event_of(run, EventKind::turning_point);
  const double F = 2.0 * EA * std::pow(h, 3) / (3.0 * std::sqrt(3.0) * std::pow(b * b + h * h, 1.5));
  EXPECT_NEAR(most.monitors[column(run, "F")], F, 1e-9 * F);
  EXPECT_NEAR(rate(run, most, 0, "F"), F / EA, 1e-7 * F / EA);
  const double by_rise = F * (3.0 / h - 3.0 * h / (b * b + h * h));
  EXPECT_NEAR(rate(run, most, 1, "F"), by_rise, 1e-7 * by_rise);
  EXPECT_NEAR(most.sensitivity[1].slope.value(), 1.0 - 1.0 / std::sqrt(3.0), 1e-7);
}

// The force at a given way, and the way at a given force.
TEST(MonitorSensitivity, OfAValueThatIsPassedIsThatOfItsClosedForm) {
  const TracedDeck run(pushed_truss("watch = { value = { lambda = [0.1], F = [-20.0] } }"), {keys});
  const auto events = events_of(run, EventKind::value_crossing);
  ASSERT_GE(events.size(), 2U);
  EXPECT_EQ(events[0].monitor, "lambda");
  EXPECT_NEAR(events[0].sensitivity[1].slope.value(), 0.0, 1e-9);
  EXPECT_NEAR(rate(run, events[0], 0, "F"), force_at(0.1, h) / EA, 1e-7 * force_at(0.1, h) / EA);
  EXPECT_NEAR(rate(run, events[0], 1, "F"), force_by_rise(0.1, h), 1e-7 * force_by_rise(0.1, h));
  EXPECT_EQ(events[1].monitor, "F");
  const double w = events[1].lambda, step = 1e-5;
  const double stiffness = (force_at(w + step, h) - force_at(w - step, h)) / (2.0 * step);
  EXPECT_NEAR(rate(run, events[1], 1, "F"), 0.0, 1e-6);
  EXPECT_NEAR(events[1].sensitivity[1].slope.value(), -force_by_rise(w, h) / stiffness,
              1e-6 * std::abs(force_by_rise(w, h) / stiffness));
}

namespace {

EventCurve curve_of(const std::string& deck) { return trace_event_curve(deck::read_deck_text(deck, "deck.toml"), {}); }

// Of the monitor F, the last one.
void expect_force(const EventCurve& curve, const CurvePoint& point, double force, double slope) {
  ASSERT_EQ(curve.columns.back().name, "F");
  EXPECT_NEAR(point.monitors.back(), force, 1e-8 * std::abs(force)) << point.key;
  EXPECT_NEAR(point.slopes.back().value(), slope, 1e-6 * std::abs(slope)) << point.key;
}

}  // namespace

TEST(EventCurveOfAForce, AtAGivenMovementIsItsClosedForm) {
  const EventCurve curve = curve_of(pushed_truss("watch = { value = { lambda = [0.1] } }") +
                                    "\n[curve]\nevent = { kind = \"value-crossing\" }\nparameter = \"point.top.1\"\n"
                                    "range = [0.3, 0.8]\n");
  ASSERT_EQ(curve.problem, "");
  ASSERT_GE(curve.points.size(), 5U);
  EXPECT_NEAR(curve.points.front().key, 0.3, 1e-12);
  EXPECT_NEAR(curve.points.back().key, 0.8, 1e-12);
  for (const CurvePoint& point : curve.points) {
    EXPECT_NEAR(point.lambda, 0.1, 1e-12);
    EXPECT_NEAR(point.slope.value(), 0.0, 1e-9);
    expect_force(curve, point, force_at(0.1, point.key), force_by_rise(0.1, point.key));
  }
}

TEST(EventCurveOfAForce, ThatIsGreatestIsItsClosedForm) {
  const EventCurve curve = curve_of(pushed_truss("watch = [\"F\"]") +
                                    "\n[curve]\nevent = { kind = \"turning-point\" }\nparameter = \"point.top.1\"\n"
                                    "range = [0.3, 0.8]\n");
  ASSERT_EQ(curve.problem, "");
  for (const CurvePoint& point : curve.points) {
    const double rise = point.key, L2 = b * b + rise * rise;
    const double most = 2.0 * EA * std::pow(rise, 3) / (3.0 * std::sqrt(3.0) * std::pow(L2, 1.5));
    EXPECT_NEAR(point.lambda, rise * (1.0 - 1.0 / std::sqrt(3.0)), 1e-8);
    expect_force(curve, point, most, most * (3.0 / rise - 3.0 * rise / L2));
  }
}

namespace {

struct Number {
  std::string key;
  double step;
};

std::vector<RecordEvent> located(const TracedDeck& traced) {
  std::vector<RecordEvent> events;
  for (const RecordEvent& event : traced.record().events)
    if (event.kind != EventKind::start && event.kind != EventKind::end) events.push_back(event);
  return events;
}

// dm/dn of every monitor at every event, as differences of whole runs have it, to 1e-6 of its greatest term: of the
// derivative, or of what the monitor changes by where the number does so by itself. `untold`: events that may tell
// none.
void expect_agreement(const std::string& deck, const std::vector<Number>& numbers,
                      std::optional<EventKind> untold = std::nullopt) {
  std::string wanted = "path.sensitivity=[";
  for (const Number& number : numbers) wanted += (wanted.back() == '[' ? "'" : ",'") + number.key + "'";
  const TracedDeck traced(deck, {wanted + "]"});
  const auto events = located(traced);
  ASSERT_FALSE(events.empty());
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const double value = events.front().sensitivity.at(n).value, step = numbers[n].step;
    std::vector<std::vector<double>> expected(events.size(), std::vector<double>(events[0].monitors.size(), 0.0));
    for (const auto& [offset, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      const auto other = located(TracedDeck(deck, {fmt::format("{}={:.17g}", numbers[n].key, value + offset * step)}));
      ASSERT_EQ(other.size(), events.size());
      for (std::size_t i = 0; i < events.size(); ++i)
        for (std::size_t m = 0; m < expected[i].size(); ++m)
          expected[i][m] += weight / (12.0 * step) * other[i].monitors[m];
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      const RecordSensitivity& found = events[i].sensitivity[n];
      if (found.rates.empty() && events[i].kind == untold) continue;
      ASSERT_EQ(found.rates.size(), expected[i].size()) << found.why_none;
      for (std::size_t m = 0; m < expected[i].size(); ++m) {
        SCOPED_TRACE(fmt::format("{} {}, monitor {} by {}", to_text(events[i].kind), events[i].lambda, m, found.key));
        if (traced.record().columns[m].name == "use-place") continue;  // it jumps
        if (!found.rates[m] && events[i].kind == untold) continue;
        ASSERT_TRUE(found.rates[m]);
        // What a length does at the event's own state is no small change, so that states which follow it tell the rate:
        // of a stress, in which great terms cancel, to 2e-5.
        const bool is_stress_by_length = traced.record().columns[m].name == "use" && found.key == "point.B.0";
        const double tolerance = is_stress_by_length ? 2e-5 : 1e-6;
        double greatest = 0.0;  // of the monitor: a force that is zero at an event is round-off of it
        for (const RecordEvent& event : events) greatest = std::max(greatest, std::abs(event.monitors[m]));
        const double scale = std::max(
            {std::abs(expected[i][m]), std::abs(events[i].monitors[m] / value), 1e-9 * greatest / std::abs(value)});
        EXPECT_NEAR(*found.rates[m], expected[i][m], tolerance * scale);
      }
    }
  }
}

// A column in a channel, shortened by its end; `path` besides.
std::string channel(const std::string& path, const std::string& more) {
  return title("A column in a channel") + material("m", 21000.0, "nu = 0.29; allowable = 30.0") +
         rectangle("s", 0.1, 0.1) + points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) + supports({{"A", "x z"}, {"B", "z"}}) +
         monitor("mid", "column:0.5", "z") + monitor("P", "B", "reaction-x") + monitor("turn", "A", "rotation") +
         wall_monitor("wall", "upper", "force-z") + monitor("M", "column:0.25", "moment") +
         table("[[monitor]]", R"(name = "use"; member = "column"; component = "utilisation")") +
         test::column_in_channel(20) + more + "\n[path]\n" + path + "\n";
}

const std::string shortened = "[[prescribed]]\nat = \"B\"\nx = -1.0\n";

}  // namespace

TEST(MonitorSensitivity, OfAShortenedColumnInAChannelIsThatOfOtherRunsSlow) {
  expect_agreement(channel("step = 0.004\nwatch = { turning = [\"P\"], value = { lambda = [0.004] } }\n"
                           "stop.event = \"limit-point\"\nstop.lambda = [-1.0, 0.03]",
                           shortened),
                   {{"wall.upper.profile.z", 2e-4}, {"section.s.height", 1e-4}, {"material.m.E", 20.0}});
}

TEST(MonitorSensitivity, OfAPressedColumnInAChannelIsThatOfOtherRunsSlow) {
  expect_agreement(channel("step = 0.05\nstop.lambda = [-1.0, 10.0]\nstop.event = \"limit-point\"",
                           "[[load]]\nat = \"B\"\nforce = [-1.0, 0.0]"),
                   {{"wall.upper.profile.z", 2e-4}, {"point.B.0", 2e-3}});
}

// A tapered strip that its tip is moved down presses on a drum: by the sizes at the tip and at the clamp.
TEST(MonitorSensitivity, OfATaperedStripOnADrumIsThatOfOtherRunsSlow) {
  const std::string deck = R"toml(
title = "A tapered strip pressed on a drum"
material.steel = { E = 2.0e5, allowable = 500.0 }
section.strip = { shape = "rectangle", width = 20.0, width_to = 12.0, height = 2.0, height_to = 1.5 }
point = { clamp = [0.0, 0.0], tip = [200.0, 0.0] }
support = { clamp = ["x", "z", "rotation"] }
prescribed = [{ at = "tip", z = -1.0 }]
path = { step = 1.0, watch = { value = { lambda = [30.0] } }, stop = { lambda = [-0.1, 40.0] } }
monitor = [{ name = "F", at = "tip", component = "reaction-z" }, { name = "turn", at = "tip", component = "rotation" }, { name = "wall", wall = "drum", component = "force-z" }, { name = "M", at = "clamp", component = "reaction-moment" }]
member.strip = { from = "clamp", to = "tip", theory = "elastica", elements = 20, material = "steel", section = "strip" }
[[wall]]
name = "drum"
outline = { type = "circle", centre = [80.0, -152.0], radius = 150.0 }
contact_surface = "axis"
)toml";
  expect_agreement(deck, {{"section.strip.width_to", 1e-2},
                          {"section.strip.height_to", 1e-3},
                          {"section.strip.width", 1e-2},
                          {"section.strip.height", 1e-3}});
}

// An arch turns at a limit point just before a compliant plate leaves it, where the pressed length is small: the second
// derivatives of the equations change fast, up to a kink. At the branch point they are lost in round-off, which is
// said.
TEST(MonitorSensitivity, BesideTheOpeningOfACompliantWallIsThatOfOtherRuns) {
  const std::string deck = title("An arch pressed by a compliant plate") + material("steel", 210000.0) +
                           rectangle("s", 10.0, 1.0) + points({{"a", -100.0, 0.0}, {"b", 100.0, 0.0}}) +
                           supports({{"a", "x z"}, {"b", "x z"}}) +
                           contact(R"(method = "compliant"; law = { stiffness = 2.0 })") +
                           path(R"(step = 0.5; stop = { lambda = [-1.0, 60.0] }; watch = ["push"])") +
                           wall_monitor("push", "plate", "force-z", flipped) + monitor("crown", "a:0.5", "z") +
                           member("a", "a", "b", "elastica", 24, "via = [0.0, 20.0]", "steel") +
                           flat_wall("plate", "above", 22.0, "motion = { z = -1.0 }");
  expect_agreement(deck, {{"contact.law.stiffness", 1e-3}, {"section.s.height", 1e-4}}, EventKind::branch_point);
}

// The ballast's law is smooth, with second derivatives that jump along the rail: longer steps average over them.
TEST(MonitorSensitivity, OfARailInItsBallastIsThatOfOtherRunsSlow) {
  expect_agreement(std::string(test::example("rail")), {{"section.track.A", 1e-5}, {"section.track.I", 1e-8}},
                   EventKind::branch_point);
}

// A law that is straight through zero has a kink there for any other value.
TEST(MonitorSensitivity, OfALawThatIsStraightThroughAKinkIsThatOfOtherRuns) {
  const std::string deck = R"toml(
title = "A shallow arch on a spring, pressed on a bump"
material.m = { E = 2.0e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
point = { a = [0.0, 0.0], c = [60.0, 5.0], b = [120.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
load = [{ at = "l:0.5", force = [0.0, -1.0] }]
spring = [{ name = "hold", at = "b", law = { direction = "x", displacement = [-1.0, -0.1, 0.0, 0.05, 0.3, 0.9], force = [-80.0, -20.0, 0.0, 10.0, 30.0, 22.0], interpolation = "linear" } }]
wall = [{ name = "floor", side = "below", profile = { type = "parabola", apex = [50.0, -3.0], curvature = -0.004 } }]
monitor = [{ name = "cz", at = "c", component = "z" }, { name = "bx", at = "b", component = "x" }]
path = { step = 1.0, jumps = false, stop = { lambda = [-5.0, 60.0] } }
[member]
l = { from = "a", to = "c", theory = "elastica", material = "m", section = "s", elements = 12 }
r = { from = "c", to = "b", theory = "elastica", material = "m", section = "s", elements = 12 }
)toml";
  expect_agreement(deck, {{"spring.0.law.force.3", 1e-3}, {"spring.0.law.displacement.3", 1e-5}});
}

}  // namespace arcwall::monitor_sensitivity_test
