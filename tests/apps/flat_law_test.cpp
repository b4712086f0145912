// A body on soil that only pushes, which no support holds up.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::flat_law_test {

namespace {

using test::TracedDeck;

// A pipe over a trench between clay and sand; what the soils do where the pipe is above them.
std::string pipe(const std::string& above) {
  return R"toml(
title = "A pipe over a trench between clay and sand"
units = { length = "m", force = "kN" }
material.steel = { E = 2.1e8 }
section.pipe = { shape = "tube", radius = 0.162, thickness = 0.0127 }
point = { west = [0.0, 0.0], edge1 = [60.0, 0.0], edge2 = [100.0, 0.0], east = [160.0, 0.0] }
support = { west = ["x", "rotation"], east = ["rotation"] }
load = [{ on = "clay", distributed = [0.0, -1.0] }, { on = "span", distributed = [0.0, -1.0] }, { on = "sand", distributed = [0.0, -1.0] }]
path = { stop = { lambda = [-0.1, 3.0] } }
monitor = [{ name = "sag", at = "span:0.5", component = "z", sign = -1 }]
[member]
clay = { from = "west", to = "edge1", theory = "elastica", material = "steel", section = "pipe", elements = 30 }
span = { from = "edge1", to = "edge2", theory = "elastica", material = "steel", section = "pipe", elements = 40 }
sand = { from = "edge2", to = "east", theory = "elastica", material = "steel", section = "pipe", elements = 30 }
[[spring]]
name = "clay"
on = "clay"
law = { direction = "z", interpolation = "smooth", displacement = [-1.0, -0.0005, 0.0, 1.0], force = [-200.0, -0.1, 0.0, )toml" +
         above + R"toml(] }
[[spring]]
name = "sand"
on = "sand"
law = { direction = "z", interpolation = "smooth", displacement = [-1.0, -0.0001, 0.0, 1.0], force = [-2000.0, -0.2, 0.0, )toml" +
         above + R"toml(] }
[[wall]]
name = "trench"
members = ["span"]
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = -0.5 }
)toml";
}

}  // namespace

// Without stiffness at rest the path cannot begin, and the deck is told so with a cure. With that it begins, and what
// the cure adds is not seen in what follows.
TEST(FlatLaw, IsToldWithACureAfterWhichThePathBeginsSlow) {
  const TracedDeck flat(pipe("0.0"));
  const std::vector<std::string>& warnings = flat.model().warnings();
  const auto tells = [](const std::string& warning) {
    return warning.find("\"clay\" has slope 0 at displacement 0") != std::string::npos &&
           warning.find("as 0.001 kN/m at its last point") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(), tells), 1);
  test::expect_verified(flat);

  std::vector<double> closes;
  for (const char* above : {"0.001", "0.01"}) {
    const TracedDeck cured(pipe(above));
    const std::vector<std::string>& said = cured.model().warnings();
    EXPECT_TRUE(std::none_of(said.begin(), said.end(), tells));
    EXPECT_EQ(cured.last().lambda, 3.0);
    EXPECT_LE(cured.record().points.size(), 50U);
    closes.push_back(test::event_of(cured, EventKind::contact_closes).lambda);
    test::expect_verified(cured);
  }
  EXPECT_NEAR(closes[0], closes[1], 1e-4 * closes[0]);
}

}  // namespace arcwall::flat_law_test
