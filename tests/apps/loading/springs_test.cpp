#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// Of every kind, in every direction.
std::string springs(const UnitsOf& in) {
  return force("B", -in.kN, 0.0) +
         table("[[spring]]",
               fmt::format(R"(at = "mid"; stiffness = {{ x = {}, z = {} }})", in.per_length(0.3), in.per_length(0.8))) +
         table("[[spring]]", fmt::format(R"(at = "first:0.5"; stiffness = {{ rotation = {} }})", in.moment(0.02))) +
         table("[[spring]]", fmt::format(R"(between = ["A", "B"]; stiffness = {{ x = {}, rotation = {} }})",
                                         in.per_length(0.7), in.moment(0.05))) +
         table("[[spring]]",
               fmt::format(R"(on = "second"; foundation = {{ x = {}, z = {} }})", in.stress(0.2), in.stress(0.9))) +
         path(R"(step = 0.1; branches = "all"; depth = 1; stop = { lambda = [-0.1, 3.0] })") +
         monitor("mid", "first:0.5", "rotation");
}

// With these loads and springs the column comes to λ = 1 in one state on the deck's mesh and on one that slides, beside
// a wall that nothing touches. There its middle has turned by so much at least.
void expect_same_where_the_mesh_slides(const std::string& loaded, double least_turn) {
  const std::string path =
      test::tables::path("step = 0.05; stop = { lambda = [-1.0, 1.0] }") + monitor("turn", "first:0.5", "rotation");
  const std::string wall = R"(
[[wall]]
name = "far"
side = "below"
profile = { type = "flat", z = -50.0 }
)";
  const TracedDeck fixed(column(centimetres, loaded + path)), sliding(column(centimetres, loaded + path + wall));
  ASSERT_NE(sliding.model().sliding(), nullptr);
  const RecordPoint &a = fixed.record().points.back(), &b = sliding.record().points.back();
  EXPECT_EQ(a.lambda, 1.0);
  EXPECT_EQ(b.lambda, 1.0);
  EXPECT_GT(std::abs(a.monitors.at(0)), least_turn);
  EXPECT_NEAR(b.monitors.at(0), a.monitors.at(0), 1e-9);
  EXPECT_NEAR(b.energy, a.energy, 1e-9);
  expect_confirmed(fixed);
  expect_confirmed(sliding);
}

}  // namespace

TEST(Springs, GiveTheSameEventsInOtherUnits) {
  const TracedDeck one(column(centimetres, springs(centimetres))), other(column(metres, springs(metres)));
  ASSERT_FALSE(events_of(one, EventKind::branch_point).empty());
  expect_same_events(one, other, 1e-8);
}

TEST(Springs, GiveTheSameEventsAlongAnyPathSlow) {
  expect_same_events_along_any_path(column(centimetres, springs(centimetres)), 0.1, 1e-8);
}

TEST(Springs, AreConfirmedSlow) {
  for (const std::string theory : {"euler-bernoulli", "elastica", "reissner"}) {
    SCOPED_TRACE(theory);
    const TracedDeck traced(column(centimetres, springs(centimetres), theory));
    expect_confirmed(traced);
  }
}

// A force and a spring between the same places: with a wall that nothing touches the path is the one without.
TEST(Springs, ActWhereForcesDoWhateverTheMesh) {
  const std::string loaded = force("B", -0.2, 0.0) + force("mid", 0.0, 0.05) +
                             table("[[spring]]", R"(between = ["A", "mid"]; stiffness = { z = 3.0, rotation = 0.4 })");
  expect_same_where_the_mesh_slides(loaded, 1e-3);
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

// A stiff lever with a load P in its middle rests on a spring at its end, which bears P/2 at any slope: the load is
// twice the force of the law, which has its maximum 0.7 at 0.2, and 0.2 at 0.5.
TEST(Springs, BearByALawWhatStaticsSay) {
  const std::string text =
      title("Lever") + material("m", 1e4) + general_section("s", 100.0, 100.0) +
      points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) + member("lever", "A", "B", "euler-bernoulli", 2) +
      supports({{"A", "x z"}}) + force("lever:0.5", 0.0, -1.0) +
      path("step = 0.05; output_at = { B = [-0.1] }; stop = { B = [-0.45, 1.0] }") + monitor("B", "B", "z") +
      table(
          "[[spring]]",
          R"(at = "B"; law = { direction = "z", displacement = [-0.5, -0.2, 0.0, 0.2, 0.5], force = [-0.2, -0.7, 0.0, 0.7, 0.2], interpolation = "smooth" })");
  const TracedDeck traced(text);
  const auto limits = events_of(traced, EventKind::limit_point);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_NEAR(limits[0].lambda, 1.4, 1e-6);
  EXPECT_NEAR(limits[0].monitors[0], -0.2, 1e-4);
  EXPECT_EQ(limits[0].unstable_after, 1);
  const auto& points = traced.record().points;
  const auto half = std::find_if(points.begin(), points.end(),
                                 [](const RecordPoint& point) { return std::abs(point.monitors[0] + 0.1) < 1e-9; });
  ASSERT_NE(half, points.end());
  // Half way to 0.2: 0.7/2 + (0.2/8) 3.5 by the slope 3.5 at the origin, between equal secants, and 0 at the maximum.
  EXPECT_NEAR(half->lambda, 2.0 * (0.35 + 0.025 * 3.5), 1e-6);
  expect_confirmed(traced);
}

// A stiff beam that cannot turn goes down as one under a load along it, which is the law's force: it has its maximum
// at 0.2, and half way there 0.4375 as above.
TEST(Springs, OfAFoundationBearByALawAsOneDoes) {
  for (const std::string theory : {"euler-bernoulli", "elastica", "reissner"}) {
    SCOPED_TRACE(theory);
    const std::string text = R"(
title = "Beam on soil"
material.m = { E = 1e4, nu = 0.3 }
section.s = { shape = "general", A = 100.0, I = 100.0 }
point = { A = [0.0, 0.0], B = [2.0, 0.0] }
member.beam = { from = "A", to = "B", theory = ")" +
                             theory +
                             R"(", elements = 4, material = "m", section = "s" }
support = { A = ["x", "rotation"] }
load = [{ on = "beam", distributed = [0.0, -1.0] }]
path = { step = 0.05, output_at = { B = [-0.1] }, stop = { B = [-0.45, 1.0] } }
monitor = [{ name = "B", at = "B", component = "z" }]
[[spring]]
on = "beam"
law = { direction = "z", displacement = [-0.5, -0.2, 0.0, 0.2, 0.5], force = [-0.2, -0.7, 0.0, 0.7, 0.2] }
)";
    const TracedDeck traced(text);
    const auto limits = events_of(traced, EventKind::limit_point);
    ASSERT_EQ(limits.size(), 1u);
    EXPECT_NEAR(limits[0].lambda, 0.7, 1e-9);
    EXPECT_NEAR(limits[0].monitors[0], -0.2, 1e-4);
    EXPECT_EQ(limits[0].unstable_after, 1);
    const auto& points = traced.record().points;
    const auto half = std::find_if(points.begin(), points.end(),
                                   [](const RecordPoint& point) { return std::abs(point.monitors[0] + 0.1) < 1e-9; });
    ASSERT_NE(half, points.end());
    EXPECT_NEAR(half->lambda, 0.35 + 0.025 * 3.5, 1e-9);
    expect_confirmed(traced);
  }
}

// A stiff lever in soil that gives way at the force f by length from the displacement d on. Where its end has moved by
// w the soil's moment is f L² (½ − 7/60 (d/w)²): below d the force is f (t + t² − t³), t = u/d, by Hermite's cubic
// with the slope f/d of the secants at 0 and 0 at d. Both that and the load at the end have arms with the same cosine.
TEST(Springs, OfAFoundationThatGivesWayHoldALeverAsStaticsSaySlow) {
  const std::string text =
      title("Lever in soil") + material("m", 1e6) + general_section("s", 100.0, 100.0) +
      points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) + member("lever", "A", "B", "elastica", 40) +
      supports({{"A", "x z"}}) + force("B", 0.0, -1.0) +
      path("step = 0.05; output_at = { B = [-0.2, -0.4] }; stop = { B = [-0.4, 1.0] }") + monitor("B", "B", "z") +
      table(
          "[[spring]]",
          R"(on = "lever"; law = { direction = "z", displacement = [-1.0, -0.1, 0.0, 0.1, 1.0], force = [-0.3, -0.3, 0.0, 0.3, 0.3] })");
  const TracedDeck traced(text);
  int found = 0;
  for (const RecordPoint& point : traced.record().points)
    for (const double w : {0.2, 0.4})
      if (std::abs(point.monitors[0] + w) < 1e-9) {
        ++found;
        EXPECT_NEAR(point.lambda, 0.3 * 2.0 * (0.5 - 7.0 / 60.0 * 0.01 / (w * w)), 1e-6) << w;
      }
  EXPECT_EQ(found, 2);
  expect_confirmed(traced);
}

// A straight column buckles by the slope k of the law at rest: EI q² − λ̂ P + λ̂² k/q² = 0, q = π/L, λ̂ = 1 − P/EA.
TEST(Springs, OfAFoundationWithALawHoldAColumnByTheirStiffnessAtRest) {
  constexpr double EI = 0.175, EA = 210.0, k = 3.0, q = 3.14159265358979323846 / 2.0;
  double P = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double shrunk = 1.0 - P / EA;
    P = (EI * q * q + shrunk * shrunk * k / (q * q)) / shrunk;
  }
  std::string more =
      "[[load]]\nat = \"B\"\nforce = [-1.0, 0.0]\n[path]\nbranches = \"primary\"\n"
      "stop = { event = \"branch-point\" }\n";
  for (const char* member : {"first", "second"})
    more += std::string("[[spring]]\non = \"") + member +
            "\"\nlaw = { direction = \"z\", displacement = [-0.2, -0.1, 0.0, 0.1, 0.2], force = [-0.4, -0.3, 0.0, "
            "0.3, 0.4] }\n";
  const TracedDeck traced(column(centimetres, more));
  const auto found = events_of(traced, EventKind::branch_point);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].lambda, P, 1e-5 * P);  // 20 elements; measured: 3e-6
}

// On meshes that slide the path is the one on the deck's, whatever the law.
TEST(Springs, OfAFoundationWithALawActWhateverTheMeshSlow) {
  const std::string loaded =
      force("B", -0.5, 0.0) + distributed("first", 0.0, 0.4) +
      table(
          "[[spring]]",
          R"(on = "first"; law = { direction = "z", displacement = [-0.5, 0.0, 0.02, 0.05, 0.5], force = [-3.0, 0.0, 0.06, 0.04, 0.3] })") +
      table("[[spring]]",
            R"(on = "second"; law = { direction = "x", displacement = [-0.5, 0.0, 0.5], force = [-0.3, 0.0, 0.3] })");
  expect_same_where_the_mesh_slides(loaded, 1e-2);
}

TEST(Springs, OfALawMustBeAtRestWithoutDisplacement) {
  const auto problem = [](const std::string& law) -> std::string {
    const std::string load = "\n[[load]]\nat = \"B\"\nforce = [-1.0, 0.0]\n";
    try {
      deck::read_deck_text(column(centimetres, "[[spring]]\nat = \"mid\"\n" + law + load), "law.toml");
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  };
  const auto law = [](const std::string& u, const std::string& force) {
    return "law = { direction = \"z\", displacement = [" + u + "], force = [" + force + "] }";
  };
  EXPECT_EQ(problem(law("-1.0, 0.0, 2.0", "-1.0, 0.0, 5.0")), "");
  EXPECT_NE(problem(law("-1.0, 0.5, 2.0", "-1.0, 0.0, 5.0")).find("without force at displacement 0"),
            std::string::npos);
  EXPECT_NE(problem(law("0.0, 1.0", "1.0, 2.0")).find("without force at displacement 0"), std::string::npos);
  EXPECT_NE(problem(law("0.0, 1.0, 0.5", "0.0, 2.0, 3.0")).find("do not increase"), std::string::npos);
  EXPECT_NE(problem(law("0.0, 1.0", "0.0")).find("2 displacements and 1 forces"), std::string::npos);
  EXPECT_NE(problem(law("0.0, 1.0", "0.0, 1.0") + "\nstiffness = { z = 1.0 }").find("does not go together"),
            std::string::npos);
}

TEST(Springs, AreNotForBars) {
  const std::string text = title("Bar") + material("m", 1.0) + general_section("s", 1.0, 1.0) +
                           points({{"A", 0.0, 0.0}, {"B", 1.0, 1.0}}) + member("bar", "A", "B", "truss", 1) +
                           supports({{"A", "x z"}, {"B", "x"}}) + force("B", 0.0, -1.0);
  const auto problem = [&](const std::string& spring) -> std::string {
    try {
      const Model model(deck::read_deck_text(text + spring, "bar.toml"));
    } catch (const InputError& error) {
      return error.diagnostics().front().key + ": " + error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_NE(problem(table("[[spring]]", R"(on = "bar"; foundation = { z = 1.0 })"))
                .find("spring.on: member \"bar\" is a truss"),
            std::string::npos);
  EXPECT_NE(problem(table("[[spring]]", R"(at = "B"; stiffness = { rotation = 1.0 })")).find("\"B\" has a rotation"),
            std::string::npos);
  EXPECT_EQ(problem(table("[[spring]]", R"(at = "B"; stiffness = { z = 1.0 })")), "");
}

}  // namespace arcwall::loading_test
