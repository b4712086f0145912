// What events depend on, against decks that are run again with other values of a number.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "core/error.hpp"
#include "model/event_names.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::sensitivity_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

// A column in a channel, whose imperfection has a third harmonic; what is in `path` besides.
std::string channel(const std::string& path, const std::string& more = "") {
  return title("A column in a channel") + material("m", 21000.0, "nu = 0.29; expansion = 1e-3") +
         rectangle("s", 0.1, 0.1) + points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) + supports({{"A", "x z"}, {"B", "z"}}) +
         monitor("mid", "column:0.5", "z") + test::column_in_channel(20) + more + "\n[path]\n" + path + "\n";
}

std::string names_of(const std::vector<std::string>& keys) {
  std::string text = "path.sensitivity=[";
  for (const std::string& key : keys) text += (text.back() == '[' ? "'" : ",'") + key + "'";
  return text + "]";
}

bool is_located(const RecordEvent& event) { return event.kind != EventKind::start && event.kind != EventKind::end; }

std::vector<RecordEvent> located(const TracedDeck& traced) {
  std::vector<RecordEvent> events;
  for (const RecordEvent& event : traced.record().events)
    if (is_located(event)) events.push_back(event);
  return events;
}

// (8 (f(h) − f(−h)) − (f(2h) − f(−2h)))/12h of the λ of each event, by runs with other values.
std::vector<double> by_runs(const std::string& deck, const std::string& key, double value, double h) {
  std::vector<double> sum;
  for (const auto& [offset, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
    const auto events = located(TracedDeck(deck, {fmt::format("{}={:.17g}", key, value + offset * h)}));
    sum.resize(events.size(), 0.0);
    for (std::size_t i = 0; i < events.size(); ++i) sum[i] += weight / (12.0 * h) * events[i].lambda;
  }
  return sum;
}

struct Number {
  std::string key;
  double step;
};

// `tolerance`: of the difference of runs, whose events are located to 1e-12 of λ or so.
void expect_agreement(const std::string& deck, const std::vector<Number>& numbers, double tolerance) {
  std::vector<std::string> keys;
  for (const Number& number : numbers) keys.push_back(number.key);
  const auto events = located(TracedDeck(deck, {names_of(keys)}));
  ASSERT_FALSE(events.empty());
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const double value = events.front().sensitivity.at(n).value;
    const std::vector<double> expected = by_runs(deck, numbers[n].key, value, numbers[n].step);
    ASSERT_EQ(expected.size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      SCOPED_TRACE(fmt::format("{} {} by {}", to_text(events[i].kind), events[i].lambda, numbers[n].key));
      const RecordSensitivity& found = events[i].sensitivity[n];
      ASSERT_TRUE(found.slope) << found.why_none;
      EXPECT_NEAR(*found.slope, expected[i], tolerance * std::abs(expected[i]));
    }
  }
}

}  // namespace

// Touch, spreading, lifting off and the snap. Values of the extensible elastica by shooting, from complex steps: by the
// gap −1.61894208038 and by the third harmonic −1024.34228122 at the snap, 0.0752436482913 and 0.152295287554 at the
// touch. The mesh of 20 elements is off by 1e-5 at most.
const std::string pressed = "[[load]]\nat = \"B\"\nforce = [-1.0, 0.0]";
const std::string to_the_snap = "step = 0.05\nstop.lambda = [-1.0, 10.0]\nstop.event = \"limit-point\"";

TEST(Sensitivity, OfAColumnInAChannelIsThatOfTheElastica) {
  const TracedDeck traced(channel(to_the_snap, pressed),
                          {"path.sensitivity=['wall.upper.profile.z','member.column.imperfection.1.amplitude']"});
  const auto& touch = event_of(traced, EventKind::contact_closes).sensitivity;
  const auto& snap = event_of(traced, EventKind::limit_point).sensitivity;
  EXPECT_NEAR(touch.at(0).slope.value(), 0.0752436482913, 1e-5 * 0.0752436482913);
  EXPECT_NEAR(touch.at(1).slope.value(), 0.152295287554, 1e-5 * 0.152295287554);
  EXPECT_NEAR(snap.at(0).slope.value(), -1.61894208038, 1e-4 * 1.61894208038);
  EXPECT_NEAR(snap.at(1).slope.value(), -1024.34228122, 1e-4 * 1024.34228122);
}

TEST(Sensitivity, OfEveryEventInAChannelIsThatOfOtherRunsSlow) {
  expect_agreement(channel(to_the_snap, pressed),
                   {{"wall.upper.profile.z", 2e-4}, {"material.m.E", 20.0}, {"point.B.0", 2e-3}}, 1e-7);
}

// λ is the end shortening, and a monitor turns: the reaction, which has its maximum before the shortening has.
TEST(Sensitivity, OfPrescribedMovementsAndOfMonitorsThatTurnSlow) {
  const std::string more =
      "[[prescribed]]\nat = \"B\"\nx = -1.0\n[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\n";
  expect_agreement(channel("step = 0.004\nwatch = [\"P\"]\nstop.event = \"limit-point\"", more),
                   {{"wall.upper.profile.z", 2e-4}, {"section.s.height", 1e-4}}, 1e-7);
}

// λ is the strain of heat between fixed ends.
TEST(Sensitivity, OfHeatSlow) {
  std::string deck =
      channel("step = 0.0005\nstop.event = \"limit-point\"", "[[load]]\non = \"column\"\ntemperature = 1e3");
  deck.replace(deck.find("B = [\"z\"]"), 9, "B = [\"x\", \"z\"]");
  expect_agreement(deck, {{"wall.upper.profile.z", 2e-4}, {"load.0.temperature", 1.0}}, 1e-7);
}

// The push of a snap-fit turns where its catch's flank ends, at a jump of the curvature.
TEST(Sensitivity, IsNotToldAtAKink) {
  const TracedDeck snap_fit(test::example("snap-fit"), {"path.sensitivity=['section.hook.height']"});
  for (const RecordEvent& event : test::events_of(snap_fit.record(), EventKind::turning_point)) {
    EXPECT_FALSE(event.sensitivity.at(0).slope) << event.id;
    EXPECT_NE(event.sensitivity[0].why_none.find("kink"), std::string::npos) << event.id;
  }
}

// A number of each example's shape: of a wall, a section, a place or an axis. Where λ hardly depends on it the
// difference of runs has fewer digits: their events are located to 1e-12 of λ, which the step h makes 1.5e-12 λ/h. Two
// events have none: the push of the snap-fit turns at a rounded corner.
TEST(Sensitivity, OfEveryExampleIsThatOfOtherRunsSlow) {
  struct Case {
    std::string name, key;
    int without = 0;  // events that have none
  };
  const std::vector<Case> cases{{"arch", "point.hinge.1"},
                                {"bow", "point.left.1"},
                                {"channel", "section.square.height"},
                                {"cylinder", "point.left.0"},
                                {"drill-string", "point.top.0"},
                                {"foundation", "section.square.height"},
                                {"guidewire", "prescribed.0.x"},
                                {"lattice", "section.bar.height"},
                                {"leaf-spring", "section.leaf.height"},
                                {"lee", "point.corner.1"},
                                {"mems-switch", "section.beam.height"},
                                {"pipeline", "section.pipe.thickness"},
                                {"portal", "section.column.I"},
                                {"rail", "section.track.I"},
                                {"snap-fit", "section.hook.height", 2},
                                {"thick", "wall.foundation.profile.z"},
                                {"truss", "point.top.1"}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name + " by " + one.key);
    const std::string deck(test::example(one.name));
    const auto events = located(TracedDeck(deck, {names_of({one.key}), "path.jumps=false"}));
    ASSERT_FALSE(events.empty());
    const double value = events.front().sensitivity.at(0).value, h = 1e-3 * std::abs(value);
    const std::vector<double> expected = by_runs(deck, one.key, value, h);
    ASSERT_EQ(expected.size(), events.size());
    int without = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      const RecordSensitivity& found = events[i].sensitivity[0];
      if (!found.slope) {
        EXPECT_NE(found.why_none.find("kink"), std::string::npos) << found.why_none;
        ++without;
        continue;
      }
      const double of_runs = 1.5e-12 * std::abs(events[i].lambda) / h;
      EXPECT_NEAR(*found.slope, expected[i], 1e-7 * std::abs(expected[i]) + of_runs)
          << to_text(events[i].kind) << " at " << events[i].lambda;
    }
    EXPECT_EQ(without, one.without);
  }
}

// EA and EI alone make the loads of Lee's frame, all of which go with E: E λ_E = A λ_A + I λ_I = λ (Euler). The
// extension of its members has a part of 1e-4 in them.
TEST(Sensitivity, ByAreaAndBySecondMomentMakeUpTheLoad) {
  const TracedDeck traced(test::example("lee"), {names_of({"material.alloy.E", "section.bar.A", "section.bar.I"})});
  const auto events = located(traced);
  ASSERT_EQ(events.size(), 4U);
  for (const RecordEvent& event : events) {
    SCOPED_TRACE(fmt::format("{} {}", to_text(event.kind), event.lambda));
    const auto part = [&](std::size_t n) { return event.sensitivity.at(n).value * event.sensitivity[n].slope.value(); };
    const double tolerance = 2e-9 * std::abs(event.lambda);  // 1e-9 of each of two
    EXPECT_NEAR(part(0), event.lambda, tolerance);
    EXPECT_NEAR(part(1) + part(2), event.lambda, tolerance);
  }
}

// A straight column buckles at P with P (1 − P/EA) = π² EI/L², a pitchfork of a symmetric branch. It moves with L and
// EA; an imperfection breaks it.
TEST(Sensitivity, OfAPitchforkThatPersists) {
  const std::string deck = title("A straight column") + material("m", 21000.0) +
                           general_section("s", 0.01, 8.333333333333333e-6) +
                           points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) + supports({{"A", "x z"}, {"B", "z"}}) +
                           force("B", -1.0, 0.0) + path(R"(step = 0.05; stop = { event = "branch-point" })") +
                           member("c", "A", "B", "elastica", 16, imperfection({{1, 0.0}}));
  const TracedDeck traced(
      deck, {"path.sensitivity=['point.B.0','section.s.I','section.s.A','member.c.imperfection.0.amplitude']"});
  const RecordEvent& buckles = event_of(traced, EventKind::branch_point);
  const double EI = 21000.0 * 8.333333333333333e-6, EA = 210.0, L = 2.0, E = 21000.0, P = buckles.lambda;
  const double slope = 1.0 - 2.0 * P / EA;  // of P (1 − P/EA)
  const double of_L = -2.0 * pi * pi * EI / (L * L * L) / slope, of_I = pi * pi * E / (L * L) / slope;
  const double of_A = -P * P / (EA * EA) * E / slope;
  const auto& found = buckles.sensitivity;
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NEAR(found[0].slope.value(), of_L, 1e-7 * std::abs(of_L));
  EXPECT_NEAR(found[1].slope.value(), of_I, 1e-7 * of_I);
  EXPECT_NEAR(found[2].slope.value(), of_A, 1e-6 * std::abs(of_A));
  EXPECT_FALSE(found[3].slope);
  EXPECT_NE(found[3].why_none.find("does not persist"), std::string::npos) << found[3].why_none;

  const auto json = event_json(traced.record(), buckles);
  EXPECT_TRUE(json["sensitivity"]["member.c.imperfection.0.amplitude"].is_null());
  EXPECT_FALSE(json["no_sensitivity"]["member.c.imperfection.0.amplitude"].get<std::string>().empty());
  EXPECT_NE(events_text(traced.record()).find("section.s.I"), std::string::npos);
}

// Both quarter points of a beam under a force at its middle touch hills at one λ. By E, which serves both, λ has a
// slope; by the height of one of them it has a corner, since the other one does not follow.
// A part beside a zone on an inclined wall buckles. It is nearly straight: its crossing is one of two curves whose
// second derivative along the mode is small beside the others, but not zero.
TEST(Sensitivity, OfABranchPointThatIsNearlyAPitchfork) {
  expect_agreement(R"toml(
title = "A bent strip is pushed against an inclined wall"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 34114.5, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
member.strip = { from = "a", to = "b", theory = "euler-bernoulli", material = "m", section = "s", elements = 20, via = [0.5, -0.0191838] }
support = { a = ["x", "z", "rotation"], b = ["x", "z", "rotation"] }
path = { step = 0.05, branches = "primary", jumps = false, stop = { lambda = [-0.3, 1.0] } }
prescribed = [{ at = "b", x = -0.114502, z = -0.014866 }]
[[wall]]
name = "w"
contact_surface = "axis"
outline = { type = "half-plane", point = [0.5, -0.1078886], normal = [-0.0621593, 0.9980662] }
)toml",
                   {{.key = "point.b.0", .step = 1e-4}, {.key = "wall.w.outline.point.1", .step = 1e-5}}, 1e-5);
}

TEST(Sensitivity, HasNoSlopeWhereContactsWouldPart) {
  const std::string deck =
      title("A beam over two hills") + material("m", 21000.0) + rectangle("s", 0.1, 0.1) +
      points({{"A", 0.0, 0.0}, {"M", 1.0, 0.0}, {"B", 2.0, 0.0}}) + supports({{"A", "x z"}, {"B", "x z"}}) +
      force("M", 0.0, -0.1) + path(R"(step = 0.05; stop = { event = "contact-closes" })") +
      member("a", "A", "M", "euler-bernoulli", 8) + member("b", "M", "B", "euler-bernoulli", 8) +
      contact(R"(points = "nodes")") +
      wall(
          "left",
          R"(side = "below"; contact_surface = "axis"; profile = { type = "parabola", apex = [0.5, -0.03], curvature = -5.0 })") +
      wall(
          "right",
          R"(side = "below"; contact_surface = "axis"; profile = { type = "parabola", apex = [1.5, -0.03], curvature = -5.0 })");
  const TracedDeck traced(deck, {"path.sensitivity=['wall.left.profile.apex.1','material.m.E']"});
  const auto& found = event_of(traced, EventKind::contact_closes).sensitivity;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].slope);
  EXPECT_FALSE(found[0].why_none.empty());
  EXPECT_TRUE(found[1].slope) << found[1].why_none;
}

// The second stage begins with the load at which the first one ends, its bound of λ; where that is something else, what
// a number changes there is not followed.
TEST(Sensitivity, OfAStageFollowsTheBoundOfTheOneBefore) {
  const auto arch = [](const std::string& stop) {
    return R"toml(
title = "An arch under two loads"
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { l = [0.0, 0.0], r = [2.0, 0.0] }
member.arch = { from = "l", to = "r", sine = { rise = 0.1, waves = 1 }, theory = "elastica", elements = 8, material = "m", section = "s" }
support = { l = ["x", "z"], r = ["x", "z"] }
load = [{ at = "arch:0.25", force = [0.0, -0.2] }, { at = "arch:0.5", force = [0.0, -1.0] }]
monitor = [{ name = "crown", at = "arch:0.5", component = "z" }]
[[stage]]
name = "side"
drives = ["load.0"]
step = 0.05
stop = )toml" +
           stop + "\n" +
           table("[[stage]]", R"(name = "crown"; drives = ["load.1"]; step = 0.01; stop = { event = "limit-point" })");
  };
  expect_agreement(arch("{ lambda = [-1.0, 0.1] }"),
                   {{"member.arch.sine.rise", 1e-4}, {"stage.side.stop.lambda.1", 1e-3}}, 1e-7);
  const TracedDeck otherwise(arch("{ crown = [-0.003, 1.0] }"), {names_of({"member.arch.sine.rise"})});
  const auto& found = event_of(otherwise, EventKind::limit_point).sensitivity;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].slope);
  EXPECT_NE(found[0].why_none.find("an earlier load step"), std::string::npos) << found[0].why_none;
}

// What is no number that changes by degrees is refused with what would be right.
TEST(Sensitivity, RefusesKeysThatAreNoNumbers) {
  const auto message_for = [](const std::string& key) -> std::string {
    try {
      TracedDeck(channel(to_the_snap, pressed), {names_of({key})});
    } catch (const InputError& error) {
      return to_text(error.diagnostics().front());
    }
    return "none";
  };
  EXPECT_NE(message_for("member.column.elements").find("whole number"), std::string::npos);
  EXPECT_NE(message_for("member.column.theory").find("no number"), std::string::npos);
  EXPECT_NE(message_for("wall.uper.profile.z").find("did you mean \"upper\""), std::string::npos);
  EXPECT_NE(message_for("path.step.0").find("there is no"), std::string::npos);
  EXPECT_EQ(message_for("wall.1.profile.z"), "none");
}

}  // namespace arcwall::sensitivity_test
