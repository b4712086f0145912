#include "apps/verify/rates.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::verify::rates_test {

using namespace test::tables;

namespace {

using test::TracedDeck;

// z of an arch's crown, with a gradient that is off by a factor.
class Observed final : public Observable {
 public:
  Observed(std::shared_ptr<const Observable> quantity, double factor)
      : quantity_(std::move(quantity)), factor_(factor) {}
  double value(const State& state) const override { return quantity_->value(state); }
  Row gradient(const State& state) const override { return ScaledObservable(quantity_, factor_).gradient(state); }

 private:
  std::shared_ptr<const Observable> quantity_;
  double factor_;
};

const std::string toggle = title("Two bars") + material("m", 1e4) + general_section("s", 1.0, 1.0) +
                           points({{"a", -1.0, 0.0}, {"b", 0.0, 0.1}, {"c", 1.0, 0.0}}) +
                           supports({{"a", "x z"}, {"c", "x z"}}) + force("b", 0.0, -1.0) + monitor("crown", "b", "z") +
                           monitor("push", "a", "reaction-x") +
                           path(R"(step = 0.1; max_points = 12; watch = ["push"])") +
                           member("l", "a", "b", "truss", 1) + member("r", "b", "c", "truss", 1);

Findings findings_of(const TracedDeck& traced, std::size_t monitor, double factor) {
  const std::vector<Watch> watched{
      {.quantity = std::make_shared<Observed>(traced.model().monitors()[monitor].quantity, factor), .label = "it"}};
  Findings findings;
  for (std::size_t i = 0; i < traced.record().points.size(); ++i)
    check_rates(watched, traced.record().points, i, findings);
  return findings;
}

}  // namespace

TEST(VerifyRates, ThatAreNoDerivativesAreRefused) {
  const TracedDeck traced(toggle);
  for (const std::size_t monitor : {0U, 1U}) {
    EXPECT_EQ(findings_of(traced, monitor, 1.0).failures(), 0);
    EXPECT_GT(findings_of(traced, monitor, 1.001).failures(), 5);
    EXPECT_GT(findings_of(traced, monitor, -1.0).failures(), 5);
  }
}

// Kinks of the laws of springs lie closer together than any difference over a part of the structure's size is wide.
TEST(VerifyRates, AndForcesOfLawsWithNarrowKinksHold) {
  test::expect_verified(TracedDeck(
      title("A cantilever on a stop that begins within a thousandth of a millimetre") + material("m", 2.06e5) +
      rectangle("s", 60.0, 8.0) + points({{"a", 0.0, 0.0}, {"b", 600.0, 0.0}}) + supports({{"a", "x z rotation"}}) +
      member("leaf", "a", "b", "elastica", 8) + force("b", 0.0, 1000.0) + monitor("tip", "b", "z") +
      path("step = 0.1; max_points = 40; stop = { lambda = [-0.1, 3.0] }") +
      table(
          "[[spring]]",
          R"(name = "stop"; at = "b"; law = { direction = "z", displacement = [-100.0, 0.0, 0.001, 10.0], force = [0.0, 0.0, 10.0, 100000.0], interpolation = "smooth" })")));
}

// The tip of a strip lies on the arc of a rounded corner, nearer to the end of the arc than differences are wide.
TEST(VerifyRates, AndCountsBesideTheEndOfAnArcHold) {
  test::expect_verified(TracedDeck(
      title("A strip's end that is bent over a rounded edge") + material("m", 900.0) + rectangle("s", 1.0, 1.5) +
      points({{"root", 0.0, 0.0}, {"rim", 20.0, 0.0}, {"bead", 20.0, -2.0}}) + supports({{"root", "x z rotation"}}) +
      member("skirt", "root", "rim", "elastica", 20) + member("bead", "rim", "bead", "elastica", 2) +
      table("[[spring]]", R"(on = "skirt"; foundation = { z = 3.375 })") +
      path("step = 0.1; stop = { lambda = [-1.0, 6.0] }") +
      wall(
          "neck",
          R"(members = ["bead"]; contact_surface = "axis"; outline = { type = "polyline", x = [20.5, 22.231, 23.231, 23.808], z = [-2.2, -1.2, -1.2, -2.2] }; corner_radius = 0.2; motion = { x = -1.0 })")));
}

// The push is greatest where the tip passes from the arc to the flat, where λ turns, too. In the last digits of its
// place it is on either, of which one holds it and the other does not.
TEST(VerifyRates, AndCountsAtTheEndOfAnArcHold) {
  test::expect_verified(TracedDeck(
      title("A strip's end that is bent over a rounded edge") + material("m", 900.0) + rectangle("s", 1.0, 1.5) +
      points({{"root", 0.0, 0.0}, {"rim", 20.0, 0.0}, {"bead", 20.0, -2.0}}) + supports({{"root", "x z rotation"}}) +
      member("skirt", "root", "rim", "elastica", 20) + member("bead", "rim", "bead", "elastica", 2) +
      table("[[spring]]", R"(on = "skirt"; foundation = { z = 3.375 })") +
      path(R"(step = 0.1; watch = ["push"]; stop = { lambda = [-1.0, 6.0], event = "limit-point" })") +
      wall_monitor("push", "neck", "force-x", flipped) +
      wall(
          "neck",
          R"(members = ["bead"]; contact_surface = "axis"; outline = { type = "polyline", x = [20.5, 22.231, 23.231, 23.808], z = [-2.2, -1.2, -1.2, -2.2] }; corner_radius = 0.2; motion = { x = -1.0 })")));
}

}  // namespace arcwall::verify::rates_test
