#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/verify/verify.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"

// What λ may drive and what holds it, as decks have it: the same events whatever the units, and runs that are
// confirmed.
namespace arcwall::loading_test {

namespace {

using test::TracedDeck;

// The user's units: so many of them are 1 cm and 1 kN.
struct UnitsOf {
  double cm = 1.0, kN = 1.0;

  double stress(double value) const { return value * kN / (cm * cm); }
  double per_length(double value) const { return value * kN / cm; }
  double moment(double value) const { return value * kN * cm; }
};

constexpr UnitsOf centimetres{}, metres{.cm = 0.01, .kN = 1000.0};

// A column of length 2 and square section 0.1 in two members, pinned left and sliding right [cm, kN].
std::string column(const UnitsOf& in, const std::string& more, const std::string& theory = "elastica") {
  return fmt::format(R"(
title = "Column"
[material.m]
E = {:.17g}
nu = 0.29
[section.s]
shape = "rectangle"
width = {height:.17g}
height = {height:.17g}
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
                     in.stress(21000.0), fmt::arg("height", 0.1 * in.cm), fmt::arg("mid", in.cm),
                     fmt::arg("end", 2.0 * in.cm), fmt::arg("theory", theory)) +
         more;
}

std::vector<RecordEvent> events_of(const TracedDeck& traced, EventKind kind) {
  std::vector<RecordEvent> found;
  for (const RecordEvent& event : traced.record().events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

// The same kinds at the same λ.
void expect_same_events(const TracedDeck& a, const TracedDeck& b, double relative) {
  const auto &first = a.record().events, &second = b.record().events;
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].kind, second[i].kind) << i;
    EXPECT_NEAR(first[i].lambda, second[i].lambda, relative * std::max(1.0, std::abs(first[i].lambda))) << i;
    EXPECT_EQ(first[i].unstable_after, second[i].unstable_after) << i;
  }
}

void expect_confirmed(const TracedDeck& traced) {
  const Record& record = traced.record();
  ASSERT_GT(record.points.size(), 5u);
  const verify::StoredFiles files{.path_csv = path_csv(record, UnitLabels::shown),
                                  .contacts_csv = record.has_walls ? contacts_csv(record, UnitLabels::shown) : "",
                                  .events_json = to_text(events_json(record), JsonLayout::lines)};
  const verify::Verdict verdict = verify::verify(traced.model(), record, files, "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << verify::to_text(*verdict.findings.first());
}

// --- springs --------------------------------------------------------------------------------------------------------

// Of every kind, in every direction.
std::string springs(const UnitsOf& in) {
  return fmt::format(R"(
[[load]]
at = "B"
force = [{:.17g}, 0.0]
[[spring]]
at = "mid"
stiffness = {{ x = {:.17g}, z = {:.17g} }}
[[spring]]
at = "first:0.5"
stiffness = {{ rotation = {:.17g} }}
[[spring]]
between = ["A", "B"]
stiffness = {{ x = {:.17g}, rotation = {:.17g} }}
[[spring]]
on = "second"
foundation = {{ x = {:.17g}, z = {:.17g} }}
[path]
step = 0.1
branches = "all"
depth = 1
[path.stop]
lambda = [-0.1, 3.0]
[[monitor]]
name = "mid"
at = "first:0.5"
component = "rotation"
)",
                     -in.kN, in.per_length(0.3), in.per_length(0.8), in.moment(0.02), in.per_length(0.7),
                     in.moment(0.05), in.stress(0.2), in.stress(0.9));
}

}  // namespace

TEST(Springs, GiveTheSameEventsInOtherUnits) {
  const TracedDeck one(column(centimetres, springs(centimetres))), other(column(metres, springs(metres)));
  ASSERT_FALSE(events_of(one, EventKind::branch_point).empty());
  expect_same_events(one, other, 1e-8);
}

TEST(Springs, AreConfirmed) {
  for (const std::string theory : {"classic", "elastica", "exact"}) {
    SCOPED_TRACE(theory);
    const TracedDeck traced(column(centimetres, springs(centimetres), theory));
    expect_confirmed(traced);
  }
}

// A beam that nothing but springs holds is no mechanism.
TEST(Springs, HoldAStructureByThemselves) {
  const std::string held = springs(centimetres);
  std::string deck = column(centimetres, held);
  const std::string supports = "A = [\"x\", \"z\"]\nB = [\"z\"]\n";
  deck.replace(deck.find(supports), supports.size(), "");
  EXPECT_GT(TracedDeck(deck).record().points.size(), 5u);
  const std::size_t first = deck.find("[[spring]]"), behind = deck.find("[path]");
  EXPECT_THROW(TracedDeck(deck.substr(0, first) + deck.substr(behind)), InputError);
}

TEST(Springs, AreNotForBars) {
  const std::string text = R"(
title = "Bar"
material.m.E = 1.0
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 1.0] }
member.bar = { from = "A", to = "B", theory = "truss", elements = 1, material = "m", section = "s" }
support = { A = ["x", "z"], B = ["x"] }
load = [{ at = "B", force = [0.0, -1.0] }]
)";
  const auto problem = [&](const std::string& spring) -> std::string {
    try {
      const Model model(deck::read_deck_text(text + spring, "bar.toml"));
    } catch (const InputError& error) {
      return error.diagnostics().front().key + ": " + error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_NE(
      problem("spring = [{ on = \"bar\", foundation = { z = 1.0 } }]").find("spring.on: member \"bar\" is a truss"),
      std::string::npos);
  EXPECT_NE(problem("spring = [{ at = \"B\", stiffness = { rotation = 1.0 } }]").find("\"B\" has a rotation"),
            std::string::npos);
  EXPECT_EQ(problem("spring = [{ at = \"B\", stiffness = { z = 1.0 } }]"), "");
}

}  // namespace arcwall::loading_test
