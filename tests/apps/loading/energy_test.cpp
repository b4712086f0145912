#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/loading/loading_decks.hpp"

namespace arcwall::loading_test {

namespace {

// The column, bent by a force that stays, and something that λ drives.
TracedDeck bent_column(const std::string& driven) {
  std::string deck = column(centimetres, R"(
[[load]]
at = "mid"
force = [0.0, 0.05]
constant = true
)" + driven + R"(
[path]
step = 0.05
branches = "primary"
output_at = { lambda = [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875] }
[path.stop]
lambda = [-0.1, 1.0]
)");
  const std::string nu = "nu = 0.29\n";
  deck.replace(deck.find(nu), nu.size(), nu + "expansion = 1e-3\n");
  return TracedDeck(deck);
}

// ∂Π/∂λ at fixed unknowns.
double energy_rate(const System& system, const State& state) {
  constexpr double step = 1e-4;
  const auto at = [&](double by) {
    State moved = state;
    moved.lambda += by;
    return system.energy(moved);
  };
  return (at(step) - at(-step)) / (2.0 * step);
}

}  // namespace

// Along a path of equilibria the energy changes by ∂Π/∂λ dλ, whatever λ drives: Simpson's rule over eight equal parts.
TEST(Energy, ChangesByItsRateInLambdaForEveryKindOfLoading) {
  const std::vector<std::string> kinds{
      "[[load]]\nat = \"B\"\nforce = [-0.1, 0.0]\n",
      "[[load]]\nat = \"B\"\nmoment = 0.05\n",
      "[[load]]\non = \"second\"\ndistributed = [-0.1, 0.2]\n",
      "[[load]]\non = \"second\"\ndistributed = [-0.1, 0.2]\nframe = \"member\"\n",
      "[[load]]\non = \"first\"\npressure = -0.1\n[[load]]\non = \"second\"\npressure = -0.1\n",
      "[[load]]\non = \"first\"\ntemperature = 20.0\ngradient = 300.0\n",
      "[[prescribed]]\nat = \"B\"\nx = -0.02\nrotation = 0.1\n",
      "[[spring]]\non = \"first\"\nfoundation = { x = 0.5, z = 2.0 }\n[[prescribed]]\nat = \"B\"\nz = 0.1\n",
  };
  for (const std::string& kind : kinds) {
    SCOPED_TRACE(kind);
    const TracedDeck traced = bent_column(kind);
    std::vector<const RecordPoint*> landed;
    for (const RecordPoint& point : traced.record().points)
      if (std::abs(point.lambda - 0.125 * double(landed.size())) < 1e-14) landed.push_back(&point);
    ASSERT_EQ(landed.size(), 9u);
    double sum = 0.0;
    for (std::size_t i = 0; i < landed.size(); ++i) {
      const double weight = i == 0 || i + 1 == landed.size() ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      sum += weight * energy_rate(traced.model().system(), landed[i]->state) * 0.125 / 3.0;
    }
    const double change = landed.back()->energy - landed.front()->energy;
    EXPECT_GT(std::abs(change), 1e-7);
    EXPECT_NEAR(change, sum, 1e-4 * std::abs(change));
  }
}

}  // namespace arcwall::loading_test
