// A watched force has its turning points told from the change of contact on with which it begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::watched_forces_test {

using namespace test::tables;

namespace {

const std::string clip =
    title("One arm of a clip that a shaft pushes aside") + material("spring", 2.06e5) + rectangle("clip", 0.9, 1.4) +
    points({{"back", -9.5, 0.0}, {"up", 6.106482, 7.277422}}) + supports({{"back", "x z rotation"}}) +
    wall("shaft", R"(outline = { type = "circle", centre = [20.0, 0.0], radius = 8.6 }; motion = { x = -1.0 })") +
    wall_monitor("push", "shaft", "force-x", flipped) +
    path(R"(step = 0.1; watch = ["push"]; stop = { lambda = [-0.5, 18.0] })") +
    member("upper", "back", "up", "elastica", 20, "via = [-4.014873, 8.609924]", "spring", "clip");

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

const std::string bent_over_a_prop =
    title("Half of a stiff beam bent over round props, held by contact alone") + material("m", 1.0, "nu = 0.3") +
    general_section("s", 1e5, 1.0) + points({{"M", 0.0, 0.0}, {"E", 1.2, 0.0}}) + supports({{"M", "x rotation"}}) +
    prescribed("M", "z = -1.0") + monitor("F", "M", "reaction-z", flipped) + monitor("N", "beam:0.25", "axial-force") +
    monitor("B", "beam:0.25", "moment") + wall_monitor("push", "prop", "force-z") +
    wall_monitor("turn", "prop", "moment") +
    path(R"(step = 0.01; watch = ["F", "N", "B", "push", "turn"]; stop = { lambda = [-0.01, 0.8] })") +
    wall("prop", R"(contact_surface = "axis"; outline = { type = "circle", centre = [0.65, -0.08], radius = 0.08 })") +
    member("beam", "M", "E", "elastica", 40);

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
  const std::string column =
      title("A perfect column past three buckling loads") + material("m", 2.1e5) + rectangle("s", 10.0, 10.0) +
      points({{"A", 0.0, 0.0}, {"B", 1000.0, 0.0}}) + supports({{"A", "x z rotation"}, {"B", "z"}}) +
      force("B", -1000.0, 0.0) + monitor("left", "A", "reaction-z") + monitor("clamp", "A", "reaction-moment") +
      monitor("bent", "column:0.5", "moment") +
      path(R"(step = 1.0; watch = ["left", "clamp", "bent"]; branches = "primary"; stop = { lambda = [-1.0, 21.0] })") +
      member("column", "A", "B", "elastica", 40);
  for (const char* const step : {"0.02", "1.0"}) {
    const Session run = test::traced(column, {std::string("path.max_step=") + step});
    EXPECT_TRUE(test::events_of(run.record(), EventKind::turning_point).empty()) << step;
    EXPECT_GE(test::events_of(run.record(), EventKind::branch_point).size(), 3U) << step;
  }
}

}  // namespace arcwall::watched_forces_test
