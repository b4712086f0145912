// Derivatives of events with respect to variables, and curves over them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "answers/event_curve.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::variable_sensitivity_test {

namespace {

// The column in a channel; a gap is the distance of its walls and four times the height of its section.
std::string channel_of_a_gap() {
  std::string deck = test::pressed_column_in_channel(20, "stop = { lambda = [-1.0, 10.0], event = \"limit-point\" }") +
                     "[variables]\nclearance = 0.2\ngap = \"2 * clearance\"\nshift = 0\n";
  const auto replace = [&](const std::string& from, const std::string& to) {
    deck.replace(deck.find(from), from.size(), to);
  };
  replace("z = 0.2", "z = \"gap / 2 + shift\"");
  replace("z = -0.2", "z = \"-gap / 2 + shift\"");
  replace("height = 0.1", "height = \"gap / 4\"");
  return deck;
}

std::vector<RecordEvent> located(const Session& session) {
  std::vector<RecordEvent> events;
  for (const RecordEvent& event : session.record().events)
    if (event.kind != EventKind::start && event.kind != EventKind::end) events.push_back(event);
  return events;
}

// (8 (f(h) − f(−h)) − (f(2h) − f(−2h)))/12h of the λ of each event, by runs with other values.
std::vector<double> by_runs(const std::string& deck, const std::string& key, double value, double h) {
  std::vector<double> sum;
  for (const auto& [offset, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
    const auto events = located(test::traced(deck, {fmt::format("{}={:.17g}", key, value + offset * h)}));
    sum.resize(events.size(), 0.0);
    for (std::size_t i = 0; i < events.size(); ++i) sum[i] += weight / (12.0 * h) * events[i].lambda;
  }
  return sum;
}

}  // namespace

// The chain rule; by both walls' shift at the snap, the extensible elastica by shooting: the lower wall is not touched.
TEST(VariableSensitivity, IsThatByAllItsKeysSlow) {
  const Session session =
      test::traced(channel_of_a_gap(), {"path.sensitivity=['wall.upper.profile.z','wall.lower.profile.z',"
                                        "'section.s.height','gap','variables.clearance','shift']"});
  const auto events = located(session);
  ASSERT_GE(events.size(), 3U);
  for (const RecordEvent& event : events) {
    std::vector<double> by;
    for (const RecordSensitivity& one : event.sensitivity) by.push_back(one.slope.value());
    const double by_gap = by[0] / 2.0 - by[1] / 2.0 + by[2] / 4.0;
    EXPECT_NEAR(by[3], by_gap, 1e-6 * std::abs(by_gap));
    EXPECT_NEAR(by[4], 2.0 * by_gap, 2e-6 * std::abs(by_gap));
    EXPECT_NEAR(by[5], by[0] + by[1], 1e-6 * (std::abs(by[0]) + std::abs(by[1])));
  }
  const auto& snap = test::event_of(session.record(), EventKind::limit_point).sensitivity;
  EXPECT_NEAR(snap.at(5).slope.value(), -1.61894208038, 1e-4 * 1.61894208038);
}

TEST(VariableSensitivity, IsThatOfOtherRunsSlow) {
  const std::string deck = channel_of_a_gap();
  const std::vector<std::pair<std::string, double>> numbers{
      {"gap", 4e-4}, {"variables.clearance", 2e-4}, {"shift", 2e-4}};
  const auto events = located(test::traced(deck, {"path.sensitivity=['gap','variables.clearance','shift']"}));
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const std::vector<double> expected =
        by_runs(deck, numbers[n].first, events.front().sensitivity.at(n).value, numbers[n].second);
    ASSERT_EQ(expected.size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i)
      EXPECT_NEAR(events[i].sensitivity[n].slope.value(), expected[i], 1e-7 * std::abs(expected[i]))
          << numbers[n].first;
  }
}

// Over a variable of which the length of a column is twice: Euler's load.
TEST(VariableSensitivity, CurvesOverAVariableAreEulersSlow) {
  const std::string text = test::straight_column(16) + R"toml([curve]
event = { kind = "branch-point" }
parameter = "half"
range = [0.75, 1.5]
[variables]
half = 1.0
)toml";
  const EventCurve curve =
      trace_event_curve(deck::read_deck_text(text, "deck.toml", {"point.B=['2 * half', 0.0]"}), {});
  EXPECT_EQ(curve.problem, "");
  ASSERT_GT(curve.points.size(), 10U);
  const double EI = 21000.0 * 8.333333333333333e-6, EA = 210.0, pi = std::acos(-1.0);
  for (const CurvePoint& point : curve.points) {
    const double P = point.lambda, L = 2.0 * point.key, slope = point.slope.value();
    EXPECT_NEAR(P * (1.0 - P / EA), pi * pi * EI / (L * L), 2e-8 * P);
    EXPECT_NEAR(slope, -4.0 * pi * pi * EI / (L * L * L) / (1.0 - 2.0 * P / EA), 1e-6 * std::abs(slope));
  }
}

}  // namespace arcwall::variable_sensitivity_test
