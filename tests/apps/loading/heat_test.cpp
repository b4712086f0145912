#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

// The same column between fixed ends, with strain λ from heat. Imperfect in the channel, or straight and alone.
std::string heated_column(const UnitsOf& in, bool in_channel, double step, double stop) {
  std::string deck = shortened_channel(in);
  const auto replace = [&](const std::string& from, const std::string& to) {
    deck.replace(deck.find(from), from.size(), to);
  };
  const auto cut = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = deck.find(from);
    deck.erase(begin, deck.find(to) - begin);
  };
  replace("nu = 0.29", "nu = 0.29\nexpansion = 1e-3");
  replace("B = [\"z\"]", "B = [\"x\", \"z\"]");
  cut("[[prescribed]]", "[[wall]]");
  replace("[[wall]]", "[[load]]\non = \"column\"\ntemperature = 1e3\n[[wall]]");
  if (!in_channel) {
    cut("imperfection", "material = ");
    cut("[[wall]]", "[path]");
  }
  cut("step = 0.004", "[[monitor]]");
  replace("[path]", fmt::format("[path]\nstep = {}\n[path.stop]\nlambda = [-0.01, {}]", step, stop));
  return deck + "[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\nsign = -1\n";
}

}  // namespace

// Between fixed ends a straight pinned column carries EA e without moving, and buckles at e = π² EI/(EA L²), exactly.
// Behind it the loads and amplitudes are those of the extensible elastica by quadrature.
TEST(Heat, BucklesAColumnBetweenFixedEndsSlow) {
  const double critical = pi * pi * 0.175 / (210.0 * 4.0);
  const TracedDeck traced(heated_column(centimetres, false, 0.0005, 10.5 * critical),
                          {fmt::format("path.output_at.lambda=[{:.17g},{:.17g},{:.17g}]", 1.1 * critical,
                                       2.0 * critical, 10.0 * critical)});
  const auto buckles = events_of(traced, EventKind::branch_point);
  ASSERT_FALSE(buckles.empty());
  EXPECT_NEAR(buckles[0].lambda, critical, 1e-8 * critical);
  struct Behind {
    double times, P, amplitude;
  };
  for (const Behind& expected :
       {Behind{1.1, 0.4317505766425992, 0.01828635917709559}, Behind{2.0, 0.4313495056895574, 0.05784648299295516},
        Behind{10.0, 0.4278213335740318, 0.1740702473955694}}) {
    const auto& points = traced.record().points;
    const auto found = std::find_if(points.rbegin(), points.rend(), [&](const RecordPoint& point) {
      return std::abs(point.lambda / critical - expected.times) < 1e-9;
    });
    ASSERT_NE(found, points.rend());
    EXPECT_NEAR(found->monitors[1], expected.P, 1e-8);
    EXPECT_NEAR(std::abs(found->monitors[0]), expected.amplitude, 1e-7);
    EXPECT_EQ(found->count.unstable, Index{0});
  }
  expect_confirmed(traced);
}

// In the channel the greatest heat and the greatest force are two events; values of the extensible elastica by
// shooting.
TEST(Heat, SnapsAColumnInAChannelAtTheGreatestHeatSlow) {
  const TracedDeck traced(heated_column(centimetres, true, 0.001, 0.15));
  for (const Pushed& expected : {Pushed{EventKind::contact_closes, 0.01581703139244, 0.423765738927, 0, 0},
                                 Pushed{EventKind::contact_splits, 0.02483532672461, 1.671915436069, 0, 0},
                                 Pushed{EventKind::limit_point, 0.06540564515039, 6.428468994643, 0, 1},
                                 Pushed{EventKind::limit_point, 0.06348366363517, 5.829107063255, 1, 0},
                                 Pushed{EventKind::contact_closes, 0.13511293387337, 3.663834738234, 0, 0}}) {
    const RecordEvent found = event_near(traced, expected.kind, expected.shortening);
    EXPECT_NEAR(found.lambda, expected.shortening, 3e-6 * expected.shortening);
    EXPECT_NEAR(found.monitors[1], expected.P, 1e-4 * expected.P);
    EXPECT_EQ(found.unstable_after, expected.after);
  }
  expect_confirmed(traced);
  expect_same_events(traced, TracedDeck(heated_column(metres, true, 0.001, 0.15)), 1e-7);
}

TEST(Heat, SnapsWithTheOrderOfTheTheorySlow) {
  constexpr double reference = 0.06540564515039;
  for (const auto& [theory, order] : {std::pair("elastica", 5.0), std::pair("euler-bernoulli", 3.5)}) {
    SCOPED_TRACE(theory);
    std::vector<double> errors;
    for (const int elements : {10, 20, 40}) {
      const TracedDeck traced(
          heated_column(centimetres, true, 0.002, 0.0655),
          {fmt::format("member.column.elements={}", elements), fmt::format("member.column.theory=\"{}\"", theory)});
      errors.push_back(event_near(traced, EventKind::limit_point, reference).lambda / reference - 1.0);
    }
    EXPECT_GT(least_order(errors, 1e-10), order) << errors[0] << ", " << errors[1] << ", " << errors[2];
  }
}

TEST(Heat, HasTheSameEventsAlongAnyPathSlow) {
  expect_same_events_along_any_path(heated_column(centimetres, true, 0.002, 0.0655), 0.002, 1e-8);
}

TEST(Heat, NeedsAMaterialThatExpandsAndATheoryThatKnowsIt) {
  const auto problem = [](const std::string& from, const std::string& to) -> std::string {
    std::string deck = heated_column(centimetres, false, 0.001, 0.01);
    deck.replace(deck.find(from), from.size(), to);
    try {
      deck::read_deck_text(deck, "hot.toml");
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_EQ(problem("title", "title"), "");
  EXPECT_EQ(problem("expansion = 1e-3\n", "\n"), "material m of member column has no expansion");
  EXPECT_NE(problem("theory = \"elastica\"", "theory = \"essenburg\"").find("does not support temperatures"),
            std::string::npos);
  EXPECT_NE(problem("temperature = 1e3", "temperature = 1e3\ndistributed = [1.0, 0.0]").find("together"),
            std::string::npos);
}

}  // namespace arcwall::loading_test
