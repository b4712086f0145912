// No step leaps over a wall, however large it is and however small the wall, whether its outline is closed or open.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/deck/reader.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::passing_test {

namespace {

// A cantilever of 400 mm, 2 mm high, under a force across at its end.
std::string cantilever(double force, const std::string& block, double step) {
  return fmt::format(R"toml(
title = "A cantilever above a block"
units = {{ length = "mm", force = "N" }}
material.s = {{ E = 210000.0 }}
section.r = {{ shape = "rectangle", width = 20.0, height = 2.0 }}
point = {{ a = [0.0, 0.0], b = [400.0, 0.0] }}
support = {{ a = ["x", "z", "rotation"] }}
member.m = {{ from = "a", to = "b", theory = "elastica", material = "s", section = "r", elements = 8 }}
load = [{{ at = "b", force = [0.0, -{}] }}]
wall = [{{ name = "w", contact_surface = "face", outline = {{ {} }} }}]
monitor = [{{ name = "R", wall = "w", component = "force-z" }}, {{ name = "tip", at = "b", component = "z" }}]
path = {{ step = {}, stop = {{ lambda = [-0.1, 1.0] }} }}
)toml",
                     force, block, step);
}

std::string block(double from, double to, double bottom) {
  return fmt::format(R"(type = "polyline", x = [{0}, {0}, {1}, {1}], z = [{2}, -2.0, -2.0, {2}])", from, to, bottom);
}

const RecordPoint& last_of(const test::TracedDeck& traced) { return traced.record().points.back(); }

}  // namespace

// Small slopes: P a²(3L − a)/6EI − R a³/3EI = 1, at the edge a = 312, with EI = 2.8·10⁶. Slopes of 0.08 make a part of
// their square of it.
TEST(Passing, AThinOpenBlockHoldsACantileverAtAnyStep) {
  const double a = 312.0, L = 400.0, P = 4.0, EI = 2.8e6;
  const double R = 3.0 * EI / std::pow(a, 3) * (P * a * a * (3.0 * L - a) / (6.0 * EI) - 1.0);
  for (const double step : {1.0, 0.2, 0.05}) {
    const test::TracedDeck traced(cantilever(4.0, block(310.0, 312.0, -3.0), step));
    test::expect_whole(traced);
    EXPECT_NEAR(last_of(traced).monitors[0], R, 1e-3 * R) << "step " << step;
  }
}

// What the open end of the block is not touched at makes no difference.
TEST(Passing, AnOpenBlockHoldsWhatAClosedOneHolds) {
  const std::string open = block(302.0, 312.0, -30.0);
  const test::TracedDeck traced(cantilever(400.0, open, 0.02)), same(cantilever(400.0, open + ", closed = true", 0.02));
  test::expect_whole(traced);
  ASSERT_GT(last_of(same).monitors[0], 500.0);
  EXPECT_NEAR(last_of(traced).monitors[0], last_of(same).monitors[0], 1e-6 * last_of(same).monitors[0]);
  EXPECT_NEAR(last_of(traced).monitors[1], last_of(same).monitors[1], 1e-6 * 400.0);
}

// States of a cantilever that nothing touches, held against a block that it leaps over between two of them.
TEST(Passing, VerifySeesAWallThatIsLeaptOverBetweenTwoPoints) {
  const test::TracedDeck traced(cantilever(4.0, block(3100.0, 3120.0, -3.0), 1.0));
  test::expect_whole(traced);
  ASSERT_LT(last_of(traced).monitors[1], -29.0);
  for (const std::string closed : {"", ", closed = true"}) {
    const std::string text = cantilever(4.0, block(310.0, 312.0, -3.0) + closed, 1.0);
    const Model with_block(deck::read_deck_text(text, "deck.toml", {}));
    const verify::Verdict verdict =
        verify::verify(with_block, traced.record(), verify::stored_files_of(traced.record()), "checkpoint");
    ASSERT_TRUE(verdict.findings.first().has_value());
    EXPECT_TRUE(verdict.findings.first()->what.starts_with("no wall is passed through between two points: m "))
        << verdict.findings.first()->what;
  }
}

}  // namespace arcwall::passing_test
