#include "apps/verify/rates.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::verify::rates_test {

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

constexpr const char* toggle = R"toml(
title = "Two bars"
material.m = { E = 1e4 }
section.s = { shape = "general", A = 1.0, I = 1.0 }
point = { a = [-1.0, 0.0], b = [0.0, 0.1], c = [1.0, 0.0] }
support = { a = ["x", "z"], c = ["x", "z"] }
load = [{ at = "b", force = [0.0, -1.0] }]
monitor = [{ name = "crown", at = "b", component = "z" }, { name = "push", at = "a", component = "reaction-x" }]
path = { step = 0.1, max_points = 12, watch = ["push"] }
member.l = { from = "a", to = "b", theory = "truss", material = "m", section = "s", elements = 1 }
member.r = { from = "b", to = "c", theory = "truss", material = "m", section = "s", elements = 1 }
)toml";

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
  test::expect_verified(TracedDeck(R"toml(
title = "A cantilever on a stop that begins within a thousandth of a millimetre"
material.m = { E = 2.06e5 }
section.s = { shape = "rectangle", width = 60.0, height = 8.0 }
point = { a = [0.0, 0.0], b = [600.0, 0.0] }
support.a = ["x", "z", "rotation"]
member.leaf = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 8 }
load = [{ at = "b", force = [0.0, 1000.0] }]
monitor = [{ name = "tip", at = "b", component = "z" }]
path = { step = 0.1, max_points = 40, stop.lambda = [-0.1, 3.0] }
[[spring]]
name = "stop"
at = "b"
law = { direction = "z", displacement = [-100.0, 0.0, 0.001, 10.0], force = [0.0, 0.0, 10.0, 100000.0], interpolation = "smooth" }
)toml"));
}

// The tip of a strip lies on the arc of a rounded corner, nearer to the end of the arc than differences are wide.
TEST(VerifyRates, AndCountsBesideTheEndOfAnArcHold) {
  test::expect_verified(TracedDeck(R"toml(
title = "A strip's end that is bent over a rounded edge"
material.m = { E = 900.0 }
section.s = { shape = "rectangle", width = 1.0, height = 1.5 }
point = { root = [0.0, 0.0], rim = [20.0, 0.0], bead = [20.0, -2.0] }
support.root = ["x", "z", "rotation"]
member.skirt = { from = "root", to = "rim", theory = "elastica", material = "m", section = "s", elements = 20 }
member.bead = { from = "rim", to = "bead", theory = "elastica", material = "m", section = "s", elements = 2 }
spring = [{ on = "skirt", foundation = { z = 3.375 } }]
path = { step = 0.1, stop = { lambda = [-1.0, 6.0] } }
[[wall]]
name = "neck"
members = ["bead"]
contact_surface = "axis"
outline = { type = "polyline", x = [20.5, 22.231, 23.231, 23.808], z = [-2.2, -1.2, -1.2, -2.2] }
corner_radius = 0.2
motion = { x = -1.0 }
)toml"));
}

// The push is greatest where the tip passes from the arc to the flat, where λ turns, too. In the last digits of its
// place it is on either, of which one holds it and the other does not.
TEST(VerifyRates, AndCountsAtTheEndOfAnArcHold) {
  test::expect_verified(TracedDeck(R"toml(
title = "A strip's end that is bent over a rounded edge"
material.m = { E = 900.0 }
section.s = { shape = "rectangle", width = 1.0, height = 1.5 }
point = { root = [0.0, 0.0], rim = [20.0, 0.0], bead = [20.0, -2.0] }
support.root = ["x", "z", "rotation"]
member.skirt = { from = "root", to = "rim", theory = "elastica", material = "m", section = "s", elements = 20 }
member.bead = { from = "rim", to = "bead", theory = "elastica", material = "m", section = "s", elements = 2 }
spring = [{ on = "skirt", foundation = { z = 3.375 } }]
path = { step = 0.1, watch = ["push"], stop = { lambda = [-1.0, 6.0], event = "limit-point" } }
monitor = [{ name = "push", wall = "neck", component = "force-x", sign = -1 }]
[[wall]]
name = "neck"
members = ["bead"]
contact_surface = "axis"
outline = { type = "polyline", x = [20.5, 22.231, 23.231, 23.808], z = [-2.2, -1.2, -1.2, -2.2] }
corner_radius = 0.2
motion = { x = -1.0 }
)toml"));
}

}  // namespace arcwall::verify::rates_test
