#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/verify/verify.hpp"
#include "tests/apps/traced_deck.hpp"

// What λ may drive and what holds it, as decks have it: the same events whatever the units, and runs that are
// confirmed.
namespace arcwall::loading_test {

using test::TracedDeck;

// The user's units: so many of them are 1 cm and 1 kN.
struct UnitsOf {
  double cm = 1.0, kN = 1.0;

  double stress(double value) const { return value * kN / (cm * cm); }
  double per_length(double value) const { return value * kN / cm; }
  double moment(double value) const { return value * kN * cm; }
};

inline constexpr UnitsOf centimetres{}, metres{.cm = 0.01, .kN = 1000.0};

// Steel, and a square section of height 0.1 [cm, kN].
inline std::string square_bar(const UnitsOf& in) {
  return fmt::format(R"(
[material.m]
E = {:.17g}
nu = 0.29
[section.s]
shape = "rectangle"
width = {height:.17g}
height = {height:.17g}
)",
                     in.stress(21000.0), fmt::arg("height", 0.1 * in.cm));
}

// A column of length 2 and square section 0.1 in two members, pinned left and sliding right [cm, kN].
inline std::string column(const UnitsOf& in, const std::string& more, const std::string& theory = "elastica") {
  return fmt::format(R"(
title = "Column"
{}
[point]
A = [0.0, 0.0]
mid = [{mid:.17g}, 0.0]
B = [{end:.17g}, 0.0]
[member]
first = {{ from = "A", to = "mid", theory = "{theory}", elements = 10, material = "m", section = "s" }}
second = {{ from = "mid", to = "B", theory = "{theory}", elements = 10, material = "m", section = "s" }}
[support]
A = ["x", "z"]
B = ["z"]
)",
                     square_bar(in), fmt::arg("mid", in.cm), fmt::arg("end", 2.0 * in.cm), fmt::arg("theory", theory)) +
         more;
}

// The same kinds at the same λ.
inline void expect_same_events(const TracedDeck& a, const TracedDeck& b, double relative) {
  const auto &first = a.record().events, &second = b.record().events;
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].kind, second[i].kind) << i;
    EXPECT_NEAR(first[i].lambda, second[i].lambda, relative * std::max(1.0, std::abs(first[i].lambda))) << i;
    EXPECT_EQ(first[i].unstable_after, second[i].unstable_after) << i;
  }
}

inline void expect_confirmed(const TracedDeck& traced) {
  const Record& record = traced.record();
  ASSERT_GT(record.points.size(), 5u);
  const verify::StoredFiles files{.path_csv = path_csv(record, UnitLabels::shown),
                                  .contacts_csv = record.has_walls ? contacts_csv(record, UnitLabels::shown) : "",
                                  .events_json = to_text(events_json(record), JsonLayout::lines)};
  const verify::Verdict verdict = verify::verify(traced.model(), record, files, "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << verify::to_text(*verdict.findings.first());
}

// The only event of its kind near a λ, as part of a run; fails the test if there is none.
inline RecordEvent event_near(const TracedDeck& traced, EventKind kind, double lambda) {
  const auto events = events_of(traced, kind);
  const auto nearest = std::min_element(events.begin(), events.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.lambda - lambda) < std::abs(b.lambda - lambda);
  });
  if (nearest != events.end()) return *nearest;
  ADD_FAILURE() << "no such event";
  return {.monitors = {0.0, 0.0, 0.0}};
}

// The column of Selke and Kikuchi's channel, 0.15 from both walls, with a half sine and a third harmonic; its right end
// is pushed by a support [cm, kN].
inline std::string shortened_channel(const UnitsOf& in, const std::string& more = "") {
  return fmt::format(R"(
title = "Column in a channel, shortened"
{}
[point]
A = [0.0, 0.0]
B = [{length:.17g}, 0.0]
[member.column]
from = "A"
to = "B"
theory = "elastica"
elements = 40
imperfection = [{{ shape = "sine", amplitude = {first:.17g}, waves = 1 }}, {{ shape = "sine", amplitude = {third:.17g}, waves = 3 }}]
material = "m"
section = "s"
[support]
A = ["x", "z"]
B = ["z"]
[[prescribed]]
at = "B"
x = {way:.17g}
[[wall]]
name = "upper"
side = "above"
profile = {{ type = "flat", z = {wall:.17g} }}
[[wall]]
name = "lower"
side = "below"
profile = {{ type = "flat", z = -{wall:.17g} }}
[path]
step = 0.004
[path.stop]
lambda = [-0.01, 0.33]
[[monitor]]
name = "mid"
at = "column:0.5"
component = "z"
)",
                     square_bar(in), fmt::arg("length", 2.0 * in.cm), fmt::arg("first", 0.00176 * in.cm),
                     fmt::arg("third", 0.0001 * in.cm), fmt::arg("way", -in.cm), fmt::arg("wall", 0.2 * in.cm)) +
         more;
}

// The order in the element length that errors show between meshes of which each has twice the elements of the one
// before; those that are round-off are left out.
inline double least_order(const std::vector<double>& errors, double round_off) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < errors.size(); ++i)
    if (std::abs(errors[i]) > round_off) least = std::min(least, std::log2(std::abs(errors[i - 1] / errors[i])));
  return least;
}

// The same events with steps of a quarter and four times the deck's, and by four other path methods.
inline void expect_same_events_along_any_path(const std::string& deck, double step, double relative) {
  const TracedDeck usual(deck);
  ASSERT_FALSE(usual.record().events.empty());
  for (const double factor : {0.25, 4.0}) {
    SCOPED_TRACE(factor);
    expect_same_events(TracedDeck(deck, {fmt::format("path.step={:.17g}", factor * step)}), usual, relative);
  }
  for (const std::string method : {"riks", "normal-plane", "cylindrical", "pseudo-arclength"}) {
    SCOPED_TRACE(method);
    expect_same_events(TracedDeck(deck, {"path.method=\"" + method + "\""}), usual, relative);
  }
}

// An event with the force P with which the support pushes, by shooting.
struct Pushed {
  EventKind kind;
  double shortening, P;
  Index before, after;
};

}  // namespace arcwall::loading_test
