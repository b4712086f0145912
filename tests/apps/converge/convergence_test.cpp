// How sure events are: orders and error bars from several meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include "apps/converge/convergence.hpp"
#include "apps/converge/convergence_files.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::convergence_test {
namespace {

// λ(h) = 2 + h⁴ on meshes of which each is twice as fine.
std::vector<double> of_order_four(int meshes) {
  std::vector<double> values;
  for (double h = 1.0; meshes > 0; --meshes, h *= 0.5) values.push_back(2.0 + std::pow(h, 4));
  return values;
}

deck::Deck lee() { return deck::read_deck_text(test::example("lee"), "lee.toml"); }

const ConvergedEvent& only(const Convergence& study, EventKind kind, Index number) {
  for (const ConvergedEvent& one : study.events)
    if (one.event.kind == kind && one.number == number) return one;
  throw std::runtime_error("there is no such event");
}

}  // namespace

TEST(Extrapolation, TakesOutAnErrorWithAnOrder) {
  const Extrapolation limit = extrapolated(of_order_four(3), 2.0, 1e-14);
  EXPECT_NEAR(limit.order.value(), 4.0, 1e-12);
  EXPECT_NEAR(limit.value, 2.0, 1e-14);
  EXPECT_GE(limit.error.value(), std::abs(limit.value - 2.0));
  EXPECT_NEAR(limit.error.value(), std::pow(0.25, 4), 1e-12);
  EXPECT_TRUE(limit.irregular.empty());
}

TEST(Extrapolation, SaysWhereNoOrderIsTrusted) {
  EXPECT_EQ(extrapolated({1.0}, 2.0, 0.0).irregular, "on one mesh only");
  EXPECT_FALSE(extrapolated({1.0}, 2.0, 0.0).error);
  EXPECT_EQ(extrapolated({1.0, 1.1}, 2.0, 0.0).irregular, "on two meshes only");
  const Extrapolation swings = extrapolated({1.0, 1.2, 1.1}, 2.0, 0.0);
  EXPECT_FALSE(swings.order);
  EXPECT_EQ(swings.irregular, "the values swing");
  EXPECT_EQ(swings.value, 1.1);
  EXPECT_NEAR(swings.error.value(), 0.2, 1e-12);
  EXPECT_FALSE(extrapolated({1.0, 1.1, 1.2}, 2.0, 0.0).irregular.empty());
  EXPECT_FALSE(extrapolated({0.0, 1.0, 1.5, 1.5001}, 2.0, 0.0).irregular.empty());
}

// Below what is not sure of the values themselves nothing is made of their differences.
TEST(Extrapolation, MakesNothingOfRoundOff) {
  const Extrapolation limit = extrapolated({1.0, 1.0 + 1e-13, 1.0 - 1e-13}, 2.0, 1e-12);
  EXPECT_FALSE(limit.order);
  EXPECT_TRUE(limit.irregular.empty());
  EXPECT_EQ(limit.value, 1.0 - 1e-13);
  EXPECT_LT(limit.error.value(), 2e-12);
}

// Limit loads by shooting with Taylor series. Classic beams have order 4; the bars hold the truth, and not by being
// wide.
TEST(Convergence, OfLeesFrameHoldsTheTruth) {
  const auto study = converge(lee(), {});
  ASSERT_TRUE(study);
  ASSERT_EQ(study->meshes.size(), 3U);
  EXPECT_EQ(study->own_mesh, 1U);
  EXPECT_EQ(study->meshes[0].elements, (std::vector<int>{10, 2, 8}));
  EXPECT_EQ(study->meshes[2].elements, (std::vector<int>{40, 8, 32}));
  for (const auto& [number, truth] : {std::pair(Index{1}, 1.85567275376), std::pair(Index{2}, -0.94144315556)}) {
    const ConvergedEvent& limit = only(*study, EventKind::limit_point, number);
    EXPECT_NEAR(limit.lambda.limit.order.value(), 4.0, 0.3);
    EXPECT_LE(std::abs(limit.lambda.limit.value - truth), limit.lambda.limit.error.value());
    EXPECT_LE(limit.lambda.limit.error.value(), 1e-5);
    EXPECT_LE(std::abs(limit.lambda.on_mesh[1].value() - truth), limit.lambda.error_of_deck.value());
    EXPECT_LE(limit.lambda.error_of_deck.value(), 20.0 * std::abs(limit.lambda.on_mesh[1].value() - truth));
  }
  for (const ConvergedEvent& one : study->events)
    for (const auto& lambda : one.lambda.on_mesh) EXPECT_TRUE(lambda.has_value());
}

// So do the displacements of the loaded point there, to the right and down.
TEST(Convergence, OfTheMonitorsOfLeesFrameHoldsTheTruth) {
  const auto study = converge(lee(), {});
  ASSERT_TRUE(study);
  ASSERT_EQ(study->columns.at(0).name, "down");
  ASSERT_EQ(study->columns.at(1).name, "right");
  for (const auto& [number, down, right] : {std::tuple(Index{1}, 48.735137245104, 26.880573741639),
                                            std::tuple(Index{2}, 58.216815328711, 90.195673535530)}) {
    const ConvergedEvent& limit = only(*study, EventKind::limit_point, number);
    for (const auto& [monitor, truth] : {std::pair(0U, down), std::pair(1U, right)}) {
      SCOPED_TRACE(study->columns[monitor].name);
      const ConvergedValue& value = limit.monitors.at(monitor);
      EXPECT_NEAR(value.limit.order.value(), 4.0, 0.5);
      EXPECT_LE(std::abs(value.limit.value - truth), value.limit.error.value());
      EXPECT_LE(value.limit.error.value(), 1e-3);
      EXPECT_LE(std::abs(value.on_mesh[1].value() - truth), value.error_of_deck.value());
    }
  }
  const std::string text = convergence_text(*study);
  EXPECT_NE(text.find("Monitors at the events"), std::string::npos);
  const std::vector<std::string> none;
  const auto json = convergence_json(*study, {.text = test::example("lee"), .assignments = none});
  EXPECT_EQ(json["events"][0]["monitors"]["right"]["values"].size(), 3U);
}

// What cannot be halved begins with the deck's own mesh and says so.
TEST(Convergence, BeginsWithTheDecksMeshWhereThatCannotBeHalved) {
  deck::Deck deck = lee();
  for (deck::Member& member : deck.members) member.elements = member.name == "short" ? 1 : 5;
  const auto study = converge(deck, {.levels = 2});
  ASSERT_TRUE(study);
  EXPECT_EQ(study->own_mesh, 0U);
  EXPECT_EQ(study->meshes[1].elements, (std::vector<int>{10, 2, 10}));
  EXPECT_EQ(study->notes.size(), 1U);
}

// A cantilever pressed on a floor of springs. What it touches first does not depend on them; what lifts its middle
// does.
TEST(Convergence, CountsHowFarSpringsGiveWay) {
  const std::string text = R"toml(
title = "A cantilever over two hills of springs"
material.m = { E = 21000.0 }
section.s = { shape = "rectangle", width = 0.1, height = 0.1 }
point = { A = [0.0, 0.0], B = [2.0, 0.0] }
support = { A = ["x", "z", "rotation"] }
load = [{ at = "B", force = [0.0, -1.0] }]
path = { step = 0.05, stop = { lambda = [-1.0, 1.0] } }
contact = { points = "nodes", method = "penalty", penalty = 1000.0 }
wall = [{ name = "near", side = "below", contact_surface = "axis", profile = { type = "parabola", apex = [1.0, -0.05], curvature = -20.0 } }, { name = "far", side = "below", contact_surface = "axis", profile = { type = "parabola", apex = [2.0, -0.3], curvature = -0.5 } }]
member.c = { from = "A", to = "B", theory = "euler-bernoulli", elements = 8, material = "m", section = "s" }
)toml";
  const auto study = converge(deck::read_deck_text(text, "hills.toml"), {});
  ASSERT_TRUE(study);
  ASSERT_GE(study->events.size(), 2U);
  EXPECT_EQ(study->notes.size(), 1U);
  EXPECT_NEAR(study->events[0].lambda.penalty.value(), 0.0, 1e-9);
  const ConvergedEvent& second = study->events[1];
  EXPECT_GT(second.lambda.penalty.value(), 1e-5);
  EXPECT_GE(second.lambda.limit.error.value(), second.lambda.penalty.value());
  for (const ConvergedEvent& one : study->events) EXPECT_TRUE(one.lambda.penalty || !one.lambda.limit.error);
}

// Bars have one element on every mesh, and so no error of the mesh.
TEST(Convergence, LeavesBarsWhole) {
  const auto study = converge(deck::read_deck_text(test::example("truss"), "truss.toml"), {});
  ASSERT_TRUE(study);
  for (const MeshRun& mesh : study->meshes) EXPECT_EQ(mesh.elements, (std::vector<int>{1, 1}));
  const ConvergedEvent& limit = only(*study, EventKind::limit_point, 1);
  EXPECT_FALSE(limit.lambda.limit.order);
  EXPECT_TRUE(limit.lambda.limit.irregular.empty());
  EXPECT_LT(limit.lambda.limit.error.value(), 1e-9);
}

// An event that one path has and the other has not leaves those behind it in their places.
TEST(Convergence, MatchesEventsByKindOrderAndPlace) {
  const test::TracedDeck traced(test::example("lee"));
  Record fewer = traced.record();
  fewer.events.erase(fewer.events.begin() + 1);
  const auto match = matched(traced.record(), fewer);
  EXPECT_FALSE(match[1]);
  for (std::size_t i = 2; i + 1 < traced.record().events.size(); ++i) EXPECT_EQ(match[i], std::optional(i - 1));
}

// A run quotes the bars of a study of its own deck alone.
TEST(Convergence, IsQuotedByRunsOfTheSameDeck) {
  namespace fs = std::filesystem;
  const auto study = converge(lee(), {.levels = 2});
  const std::vector<std::string> none, other{"path.step=0.2"};
  const StudiedDeck same{.text = test::example("lee"), .assignments = none};
  const fs::path folder = fs::path(::testing::TempDir()) / "converged";
  fs::create_directories(folder);
  std::ofstream(folder / "convergence.json") << convergence_json(*study, same).dump();
  const test::TracedDeck traced(test::example("lee"));
  const std::string text = error_bars_text(folder, traced.record(), same);
  EXPECT_NE(text.find("± error"), std::string::npos);
  EXPECT_EQ(error_bars_text(folder, traced.record(), {.text = test::example("lee"), .assignments = other}), "");
  EXPECT_EQ(error_bars_text(folder, traced.record(), {.text = "title = \"\"", .assignments = none}), "");
  std::ofstream(folder / "convergence.json") << "{ no JSON";
  EXPECT_EQ(error_bars_text(folder, traced.record(), same), "");
  fs::remove_all(folder);
}

TEST(Convergence, IsToldInATable) {
  const auto study = converge(lee(), {.levels = 2});
  const std::string text = convergence_text(*study);
  EXPECT_NE(text.find("Lee's frame"), std::string::npos);
  EXPECT_NE(text.find("limit-point"), std::string::npos);
  EXPECT_NE(text.find("on two meshes only"), std::string::npos);
}

}  // namespace arcwall::convergence_test
