// Contact that passes the ends of a rounded corner, where the path has a kink and λ may turn, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::wall_kinks_test {
namespace {

using test::TracedDeck;

// A tip on springs of stiffness 1 in x and z, over a ramp of 45° with a flat at 0.8 from x = 1.5 to 2.5, rounded by r;
// the ramp moves by λ against x.
std::string ramp(double r, const std::string& points) {
  return fmt::format(R"toml(
title = "A sprung tip over a rounded ramp"
material.m = {{ E = 1.0e6 }}
section.s = {{ shape = "rectangle", width = 1.0, height = 0.1 }}
point = {{ top = [0.0, 1.0], tip = [0.0, 0.0] }}
support = {{ tip = ["rotation"] }}
monitor = [{{ name = "x", at = "tip", component = "x" }}, {{ name = "z", at = "tip", component = "z" }}]
spring = [{{ at = "tip", stiffness = {{ x = 1.0, z = 1.0 }} }}]
member.stub = {{ from = "top", to = "tip", theory = "elastica", material = "m", section = "s", elements = 1 }}
contact.points = "{1}"
path = {{ step = 0.1, stop = {{ lambda = [-1.0, 3.5] }} }}
[[wall]]
name = "ramp"
acts_on = "axis"
outline = {{ type = "polyline", x = [0.5, 1.5, 2.5, 3.5], z = [-0.2, 0.8, 0.8, -0.2] }}
corner_radius = {0}
motion = {{ x = -1.0 }}
)toml",
                     r, points);
}

// λ where the tip touches the rising arc at a slope: the wall presses it up by z and back by z times the slope.
double lambda_on_arc(double r, double slope) {
  const double centre = 1.5 + r * std::tan(std::atan(1.0) / 2.0);
  const double z = 0.8 - r + r * std::cos(slope);
  return centre - r * std::sin(slope) + z * std::tan(slope);
}

std::vector<const RecordEvent*> limit_points(const TracedDeck& traced) {
  std::vector<const RecordEvent*> found;
  for (const RecordEvent& event : traced.record().events)
    if (event.kind == EventKind::limit_point) found.push_back(&event);
  return found;
}

class WallKinks : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Points, WallKinks, testing::Values("moving", "nodes"),
                         [](const auto& of) { return of.param; });

// λ increases along the ramp, falls along the arc, where the push falls to zero, stays with the tip along the flat, and
// falls along the other arc.
TEST_P(WallKinks, LambdaTurnsAtTheEndsOfArcs) {
  for (const double r : {0.05, 0.1, 0.2, 0.4}) {
    SCOPED_TRACE(r);
    const TracedDeck traced(ramp(r, GetParam()));
    const double quarter = std::atan(1.0);
    const double before = lambda_on_arc(r, quarter), behind = lambda_on_arc(r, 0.0);
    const double flat = 1.0 - 2.0 * r * std::tan(quarter / 2.0);
    // On the falling side the picture is the mirror image, x against the middle of the flat.
    const double down = 4.0 - before, up = 4.0 - behind;
    const auto limits = limit_points(traced);
    ASSERT_EQ(limits.size(), 4U);
    const std::vector<double> expected{before, behind, up, down};
    for (std::size_t i = 0; i < limits.size(); ++i) {
      EXPECT_NEAR(limits[i]->lambda, expected[i], 1e-9) << i;
      EXPECT_EQ(limits[i]->unstable_before, Index(i % 2)) << i;
      EXPECT_EQ(limits[i]->unstable_after, Index((i + 1) % 2)) << i;
    }
    EXPECT_NEAR(up - behind, flat, 1e-9);
    EXPECT_LE(traced.record().points.size(), 80U);
    test::expect_whole(traced);
  }
}

// With a large radius λ falls by less than it rises: the arc is passed without a turn of λ.
TEST_P(WallKinks, LambdaDoesNotTurnOnAFlatArc) {
  const TracedDeck traced(ramp(1.1, GetParam()));
  test::expect_whole(traced);
  EXPECT_LT(lambda_on_arc(1.1, 0.3), lambda_on_arc(1.1, 0.2));
  EXPECT_TRUE(limit_points(traced).empty());
}

}  // namespace
}  // namespace arcwall::wall_kinks_test
