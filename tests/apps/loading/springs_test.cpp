#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

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

// A force and a spring between the same places: with a wall that nothing touches the path is the one without.
TEST(Springs, ActWhereForcesDoWhateverTheMesh) {
  const std::string loaded = R"(
[[load]]
at = "B"
force = [-0.2, 0.0]
[[load]]
at = "mid"
force = [0.0, 0.05]
[[spring]]
between = ["A", "mid"]
stiffness = { z = 3.0, rotation = 0.4 }
[path]
step = 0.05
[path.stop]
lambda = [-1.0, 1.0]
[[monitor]]
name = "turn"
at = "first:0.5"
component = "rotation"
)";
  const std::string wall = R"(
[[wall]]
name = "far"
side = "below"
profile = { type = "flat", z = -50.0 }
)";
  const TracedDeck fixed(column(centimetres, loaded)), sliding(column(centimetres, loaded + wall));
  ASSERT_NE(sliding.model().sliding(), nullptr);
  const RecordPoint &a = fixed.record().points.back(), &b = sliding.record().points.back();
  EXPECT_EQ(a.lambda, 1.0);
  EXPECT_EQ(b.lambda, 1.0);
  EXPECT_GT(std::abs(a.monitors.at(0)), 1e-3);
  EXPECT_NEAR(b.monitors.at(0), a.monitors.at(0), 1e-9);
  expect_confirmed(sliding);
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
