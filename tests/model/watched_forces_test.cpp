// A watched force has its turning points told from the change of contact on with which it begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/model/traced_session.hpp"

namespace arcwall::watched_forces_test {

namespace {

constexpr const char* clip = R"toml(
title = "One arm of a clip that a shaft pushes aside"
material.spring = { E = 2.06e5 }
section.clip = { shape = "rectangle", width = 0.9, height = 1.4 }
point = { back = [-9.5, 0.0], up = [6.106482, 7.277422] }
support.back = ["x", "z", "rotation"]
wall = [{ name = "shaft", outline = { type = "circle", centre = [20.0, 0.0], radius = 8.6 }, motion = { x = -1.0 } }]
monitor = [{ name = "push", wall = "shaft", component = "force-x", sign = -1 }]
path = { step = 0.1, watch = ["push"], stop.lambda = [-0.5, 18.0] }
[member.upper]
from = "back"
to = "up"
via = [-4.014873, 8.609924]
theory = "elastica"
material = "spring"
section = "clip"
elements = 20
)toml";

double greatest_push(const Record& record) {
  double greatest = 0.0;
  for (const RecordPoint& point : record.points) greatest = std::max(greatest, point.monitors[0]);
  return greatest;
}

}  // namespace

// The push rises from zero at the touch and falls again within one step of the default length. Small steps show how
// great it becomes.
TEST(WatchedForce, HasItsMaximumRightBehindATouchWhateverTheStepSlow) {
  const double greatest = greatest_push(test::traced(clip, {"path.max_step=0.002"}).record());
  for (const char* const setting : {"path.step=0.1", "path.step=1.0", "path.max_step=0.5", "path.max_step=0.05"}) {
    SCOPED_TRACE(setting);
    const Session run = test::traced(clip, {setting});
    const auto turns = test::events_of(run.record(), EventKind::turning_point);
    ASSERT_EQ(turns.size(), 2U);
    EXPECT_NEAR(turns[0].monitors[0], greatest, 1e-7 * greatest);
    EXPECT_NEAR(greatest_push(run.record()), greatest, 1e-7 * greatest);
  }
}

namespace {

constexpr const char* bent_over_a_prop = R"toml(
title = "Half of a stiff beam bent over round props, held by contact alone"
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { M = [0.0, 0.0], E = [1.2, 0.0] }
support.M = ["x", "rotation"]
prescribed = [{ at = "M", z = -1.0 }]
monitor = [{ name = "F", at = "M", component = "reaction-z", sign = -1 },
           { name = "N", at = "beam:0.25", component = "axial-force" },
           { name = "B", at = "beam:0.25", component = "moment" },
           { name = "push", wall = "prop", component = "force-z" },
           { name = "turn", wall = "prop", component = "moment" }]
path = { step = 0.01, watch = ["F", "N", "B", "push", "turn"], stop.lambda = [-0.01, 0.8] }
[[wall]]
name = "prop"
contact_surface = "axis"
outline = { type = "circle", centre = [0.65, -0.08], radius = 0.08 }
[member.beam]
from = "M"
to = "E"
theory = "elastica"
material = "m"
section = "s"
elements = 40
)toml";

struct Maximum {
  double lambda, value;
};

// The vertex of the parabola through the greatest value of the points and its neighbours in λ.
Maximum greatest(const Record& record, std::size_t monitor) {
  const std::vector<RecordPoint>& points = record.points;
  std::size_t at = 1;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (points[i].monitors[monitor] > points[at].monitors[monitor]) at = i;
  const double a = points[at - 1].lambda, b = points[at].lambda, c = points[at + 1].lambda;
  const double fa = points[at - 1].monitors[monitor], fb = points[at].monitors[monitor],
               fc = points[at + 1].monitors[monitor];
  const double ab = (fb - fa) / (b - a), bc = (fc - fb) / (c - b), bend = (bc - ab) / (c - a);
  const double lambda = 0.5 * (a + b) - 0.5 * ab / bend;
  return {lambda, fa + (lambda - a) * (ab + bend * (lambda - b))};
}

}  // namespace

// The reaction depends on the beam's strain times its stiffness EA, 10⁵ times what it bends by. The path without the
// watch, in short steps, tells where it is greatest.
TEST(WatchedForce, OfAStiffMemberHasItsMaximumWhereItIsOnAnyMeshAndStepSlow) {
  const Maximum expected =
      greatest(test::traced(bent_over_a_prop, {"path.watch=[]", "path.max_step=0.01"}).record(), 0);
  const std::pair<std::string, std::string> meshes_and_steps[] = {
      {"20", "0.2"}, {"20", "0.01"}, {"40", "0.2"}, {"80", "0.2"}};
  for (const auto& [elements, step] : meshes_and_steps) {
    SCOPED_TRACE(elements + " elements, steps " + step);
    const Session run = test::traced(bent_over_a_prop, {"member.beam.elements=" + elements, "path.max_step=" + step});
    std::vector<RecordEvent> turns = test::events_of(run.record(), EventKind::turning_point);
    std::erase_if(turns, [](const RecordEvent& turn) { return turn.monitor != "F"; });
    ASSERT_EQ(turns.size(), 1U);
    EXPECT_NEAR(turns[0].lambda, expected.lambda, 1e-4);
    EXPECT_NEAR(turns[0].monitors[0], expected.value, 1e-6 * expected.value);
  }
}

// A force that is zero by symmetry has round-off for its rate, of any sign.
TEST(WatchedForce, ThatIsZeroBySymmetryNeverTurns) {
  const char* const column = R"toml(
title = "A perfect column past three buckling loads"
material.m = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 10.0 }
point = { A = [0.0, 0.0], B = [1000.0, 0.0] }
support = { A = ["x", "z", "rotation"], B = ["z"] }
load = [{ at = "B", force = [-1000.0, 0.0] }]
monitor = [{ name = "left", at = "A", component = "reaction-z" }, { name = "clamp", at = "A", component = "reaction-moment" },
           { name = "bent", at = "column:0.5", component = "moment" }]
path = { step = 1.0, watch = ["left", "clamp", "bent"], branches = "primary", stop.lambda = [-1.0, 21.0] }
[member.column]
from = "A"
to = "B"
theory = "elastica"
material = "m"
section = "s"
elements = 40
)toml";
  for (const char* const step : {"0.02", "1.0"}) {
    const Session run = test::traced(column, {std::string("path.max_step=") + step});
    EXPECT_TRUE(test::events_of(run.record(), EventKind::turning_point).empty()) << step;
    EXPECT_GE(test::events_of(run.record(), EventKind::branch_point).size(), 3U) << step;
  }
}

}  // namespace arcwall::watched_forces_test
