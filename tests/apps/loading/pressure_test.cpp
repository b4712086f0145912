#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

// A sine arch of length 2, rise 0.2 and square section 0.1 whose feet are held, or one of them in z alone [cm, kN].
std::string pressed_arch(const UnitsOf& in, const std::string& more, const std::string& theory = "elastica",
                         const std::string& right = "\"x\", \"z\"") {
  return fmt::format(R"(
title = "Arch under pressure"
{}
[point]
l = [0.0, 0.0]
r = [{length:.17g}, 0.0]
[member.arch]
from = "l"
to = "r"
sine = {{ rise = {rise:.17g}, waves = 1 }}
imperfection = [{{ shape = "sine", amplitude = {small:.17g}, waves = 2 }}]
theory = "{theory}"
elements = 20
material = "m"
section = "s"
[support]
l = ["x", "z", "rotation"]
r = [{right}]
[[load]]
on = "arch"
pressure = {p:.17g}
[path]
step = 0.05
branches = "primary"
[path.stop]
lambda = [-0.5, 2.0]
crown = [{low:.17g}, 1.0]
[[monitor]]
name = "crown"
at = "arch:0.5"
component = "z"
[[monitor]]
name = "rests"
at = "l"
component = "reaction-z"
[[monitor]]
name = "M"
at = "arch:0.5"
component = "moment"
)",
                     square_bar(in), fmt::arg("length", 2.0 * in.cm), fmt::arg("rise", 0.2 * in.cm),
                     fmt::arg("small", 0.005 * in.cm), fmt::arg("p", in.per_length(1.0)),
                     fmt::arg("low", -0.45 * in.cm), fmt::arg("theory", theory), fmt::arg("right", right)) +
         more;
}

std::string floor_at(const UnitsOf& in, double z) {
  return fmt::format("[[wall]]\nname = \"floor\"\nside = \"below\"\nprofile = {{ type = \"flat\", z = {:.17g} }}\n",
                     z * in.cm);
}

std::string problem_of(const std::string& deck) {
  try {
    const Model model(deck::read_deck_text(deck, "pressed.toml"));
  } catch (const InputError& error) {
    return error.diagnostics().front().key + ": " + error.diagnostics().front().message;
  }
  return "";
}

}  // namespace

TEST(PressedDeck, GivesTheSameEventsInOtherUnits) {
  const TracedDeck one(pressed_arch(centimetres, "")), other(pressed_arch(metres, ""));
  ASSERT_FALSE(events_of(one, EventKind::limit_point).empty());
  expect_same_events(one, other, 1e-8);
}

TEST(PressedDeck, GivesTheSameEventsAlongAnyPathSlow) {
  expect_same_events_along_any_path(pressed_arch(centimetres, ""), 0.05, 1e-8);
}

TEST(PressedDeck, IsConfirmedWhateverTheTheoryAndTheEnds) {
  for (const std::string theory : {"euler-bernoulli", "elastica", "reissner", "essenburg"})
    for (const std::string right : {"\"x\", \"z\"", "\"z\""}) {
      SCOPED_TRACE(theory + " " + right);
      expect_confirmed(TracedDeck(pressed_arch(centimetres, "", theory, right)));
    }
}

// With a wall that nothing touches the mesh is another one, and the path the same.
TEST(PressedDeck, IsTheSameOnAMeshThatSlidesSlow) {
  for (const std::string right : {"\"x\", \"z\"", "\"z\""}) {
    const std::vector<std::string> landing{"path.output_at.lambda=[0.2]", "path.stop.lambda=[-0.1,0.2]",
                                           "path.step=0.01"};
    const TracedDeck fixed(pressed_arch(centimetres, "", "elastica", right), landing);
    const TracedDeck sliding(pressed_arch(centimetres, floor_at(centimetres, -50.0), "elastica", right), landing);
    ASSERT_NE(sliding.model().sliding(), nullptr);
    const RecordPoint &a = fixed.record().points.back(), &b = sliding.record().points.back();
    ASSERT_EQ(a.lambda, 0.2);
    ASSERT_EQ(b.lambda, 0.2);
    for (std::size_t i = 0; i < a.monitors.size(); ++i)
      EXPECT_NEAR(b.monitors[i], a.monitors[i], 1e-8 * (1e-2 + std::abs(a.monitors[i]))) << i;
    EXPECT_NEAR(b.energy, a.energy, 1e-9 * std::abs(a.energy));
    expect_confirmed(sliding);
  }
}

// The supports bear p across the line between the feet: half of it each but for what clamping one of them turns over.
TEST(PressedDeck, IsBorneByTheSupports) {
  const TracedDeck traced(
      pressed_arch(centimetres, "[[monitor]]\nname = \"right\"\nat = \"r\"\ncomponent = \"reaction-z\"\n"));
  for (const RecordPoint& point : traced.record().points)
    EXPECT_NEAR(point.monitors[1] + point.monitors[3], 2.0 * point.lambda, 1e-9 * (1.0 + std::abs(point.lambda)));
}

// It is pressed through onto a floor and lies down there. On the floor, too, what is read off is confirmed.
TEST(PressedDeck, LiesDownOnAFloorSlow) {
  for (const std::string points : {"moving", "nodes"}) {
    const TracedDeck traced(pressed_arch(centimetres, floor_at(centimetres, -0.12)),
                            {"contact.points=\"" + points + "\""});
    EXPECT_FALSE(events_of(traced, EventKind::contact_closes).empty()) << points;
    expect_confirmed(traced);
  }
}

TEST(PressedDeck, IsAppliedBeforeThePathWhereItIsConstant) {
  const std::string load = "[[load]]\nat = \"arch:0.5\"\nforce = [0.0, -0.01]\n";
  std::string deck = pressed_arch(centimetres, load);
  const std::string pressure = "pressure = 1\n";
  deck.replace(deck.find(pressure), pressure.size(), "pressure = 0.2\nconstant = true\n");
  const TracedDeck before(deck), by_lambda(pressed_arch(centimetres, ""), {"path.output_at.lambda=[0.2]"});
  const auto& points = by_lambda.record().points;
  const auto landed =
      std::find_if(points.begin(), points.end(), [](const RecordPoint& point) { return point.lambda == 0.2; });
  ASSERT_NE(landed, points.end());
  for (std::size_t i = 0; i < landed->monitors.size(); ++i)
    EXPECT_NEAR(before.record().points.front().monitors[i], landed->monitors[i], 1e-9);
  expect_confirmed(before);
}

// Loads in the frame of the member, on both meshes.
TEST(LoadInTheFrameOfItsMember, IsConfirmedAndTheSameOnAMeshThatSlidesSlow) {
  const auto deck = [](const UnitsOf& in, const std::string& more, const std::string& theory) {
    std::string text = pressed_arch(in, more, theory, "\"z\"");
    const std::size_t at = text.find("pressure = ");
    const std::string load =
        fmt::format("distributed = [{:.17g}, {:.17g}]\nframe = \"member\"\n", in.per_length(0.3), in.per_length(-1.0));
    return text.replace(at, text.find('\n', at) - at, load);
  };
  const std::vector<std::string> landing{"path.output_at.lambda=[0.1]", "path.stop.lambda=[-0.1,0.1]",
                                         "path.step=0.01"};
  const TracedDeck fixed(deck(centimetres, "", "elastica"), landing);
  const TracedDeck sliding(deck(centimetres, floor_at(centimetres, -50.0), "elastica"), landing);
  ASSERT_NE(sliding.model().sliding(), nullptr);
  const RecordPoint &a = fixed.record().points.back(), &b = sliding.record().points.back();
  ASSERT_EQ(a.lambda, 0.1);
  for (std::size_t i = 0; i < a.monitors.size(); ++i)
    EXPECT_NEAR(b.monitors[i], a.monitors[i], 1e-8 * (1e-2 + std::abs(a.monitors[i]))) << i;
  EXPECT_NEAR(b.energy, a.energy, 1e-9 * std::abs(a.energy));
  expect_confirmed(sliding);
  for (const std::string theory : {"euler-bernoulli", "elastica", "reissner", "essenburg"})
    expect_confirmed(TracedDeck(deck(centimetres, "", theory)));
  expect_same_events(TracedDeck(deck(centimetres, "", "euler-bernoulli")),
                     TracedDeck(deck(metres, "", "euler-bernoulli")), 1e-8);
  const TracedDeck down(deck(centimetres, floor_at(centimetres, -0.11), "elastica"));
  EXPECT_FALSE(events_of(down, EventKind::contact_closes).empty());
  expect_confirmed(down);
}

TEST(PressedDeck, IsRefusedWhereItHasNoEnergy) {
  EXPECT_EQ(problem_of(pressed_arch(centimetres, "")), "");
  EXPECT_EQ(problem_of(pressed_arch(centimetres, "", "elastica", "\"x\"")), "");
  EXPECT_NE(problem_of(pressed_arch(centimetres, "", "elastica", "\"rotation\""))
                .find("load.pressure: the pressure on "
                      "arch ends at \"r\""),
            std::string::npos);
  EXPECT_NE(problem_of(pressed_arch(centimetres, "[contact]\n", "truss")).find("is a truss, which cannot"),
            std::string::npos);
  std::string both = pressed_arch(centimetres, "");
  both.replace(both.find("pressure = "), 0, "distributed = [0.0, 1.0]\n");
  EXPECT_NE(problem_of(both).find("distributed: does not go together with a pressure"), std::string::npos);
}

}  // namespace arcwall::loading_test
