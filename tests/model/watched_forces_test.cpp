// A watched force has its turning points told from the change of contact on with which it begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
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
TEST(WatchedForce, HasItsMaximumRightBehindATouchWhateverTheStep) {
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

}  // namespace arcwall::watched_forces_test
