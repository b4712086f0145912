#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/apps/loading/loading_decks.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::loading_test {

using namespace test::tables;

namespace {

// A pinned sine arch of length 2 and square section 0.1 under a circle that is pushed down on its crown [cm, kN].
std::string indented_arch(const UnitsOf& in, double rise, double stop, const std::string& more = "") {
  return fmt::format(R"(
title = "Sine arch under a round indenter"
{}
[point]
l = [0.0, 0.0]
r = [{length:.17g}, 0.0]
[member.arch]
from = "l"
to = "r"
sine = {{ rise = {rise:.17g}, waves = 1 }}
theory = "elastica"
elements = 40
material = "m"
section = "s"
[support]
l = ["x", "z"]
r = ["x", "z"]
[[wall]]
name = "indenter"
side = "above"
contact_surface = "axis"
profile = {{ type = "circle", centre = [{radius:.17g}, {centre:.17g}], radius = {radius:.17g} }}
motion = {{ z = {way:.17g} }}
[path]
step = 0.003
branches = "primary"
watch = ["F"]
[path.stop]
lambda = [-0.01, {stop}]
[[monitor]]
name = "crown"
at = "arch:0.5"
component = "z"
[[monitor]]
name = "F"
wall = "indenter"
component = "force-z"
sign = -1
)",
                     square_bar(in), fmt::arg("length", 2.0 * in.cm), fmt::arg("rise", rise * in.cm),
                     fmt::arg("radius", in.cm), fmt::arg("centre", (1.0 + rise) * in.cm), fmt::arg("way", -in.cm),
                     fmt::arg("stop", stop)) +
         more;
}

}  // namespace

// While it touches at one point the force is that of a dead central load at the same height of the crown; values by
// independent solvers. The force turns, but λ does not: a way does not snap.
TEST(MovingWall, PushesAFlatArchThroughWithoutASnapSlow) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.17));
  const RecordEvent greatest = event_near(traced, EventKind::turning_point, 0.056131352628);
  EXPECT_NEAR(greatest.lambda, 0.056131352628, 2e-5 * greatest.lambda);
  EXPECT_NEAR(greatest.monitors[1], 0.17024981411406, 1e-5 * greatest.monitors[1]);
  EXPECT_NEAR(0.1 + greatest.monitors[0], 0.043868647372, 1e-5);
  const RecordEvent least = event_near(traced, EventKind::turning_point, 0.147704654127);
  EXPECT_NEAR(least.lambda, 0.147704654127, 2e-5 * least.lambda);
  EXPECT_NEAR(least.monitors[1], 0.039265852399, 1e-4 * least.monitors[1]);
  EXPECT_TRUE(events_of(traced, EventKind::limit_point).empty());
  expect_confirmed(traced);
  expect_same_events(traced, TracedDeck(indented_arch(metres, 0.1, 0.17)), 1e-7);
}

// A steeper arch sways; the round indenter holds it longer than a dead force, under which it sways at a crown of
// 0.1415. Value by an independent solver.
TEST(MovingWall, HoldsASteepArchByItsCurvature) {
  const TracedDeck traced(indented_arch(centimetres, 0.2, 0.2));
  const auto sways = events_of(traced, EventKind::branch_point);
  ASSERT_FALSE(sways.empty());
  EXPECT_NEAR(sways[0].lambda, 0.1024273364847, 2e-5 * sways[0].lambda);
  EXPECT_NEAR(sways[0].monitors[1], 0.8000581193, 3e-5);
  EXPECT_EQ(sways[0].unstable_before, 0);
  EXPECT_EQ(sways[0].unstable_after, 1);
}

TEST(MovingWall, LetsAnArchSwayWithTheOrderOfTheTheory) {
  constexpr double reference = 0.1024273364847;
  for (const auto& [theory, order] : {std::pair("elastica", 5.0), std::pair("euler-bernoulli", 3.5)}) {
    SCOPED_TRACE(theory);
    std::vector<double> errors;
    for (const int elements : {10, 20, 40}) {
      const TracedDeck traced(
          indented_arch(centimetres, 0.2, 0.11),
          {fmt::format("member.arch.elements={}", elements), fmt::format("member.arch.theory=\"{}\"", theory)});
      errors.push_back(event_near(traced, EventKind::branch_point, reference).lambda / reference - 1.0);
    }
    EXPECT_GT(least_order(errors, 1e-10), order) << errors[0] << ", " << errors[1] << ", " << errors[2];
  }
}

TEST(MovingWall, GivesTheSameEventsAlongAnyPathSlow) {
  expect_same_events_along_any_path(indented_arch(centimetres, 0.2, 0.11), 0.003, 1e-8);
}

// Contact at nodes: the same forces as the mesh becomes fine.
TEST(MovingWall, PushesAtNodesToo) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.05, "[contact]\npoints = \"nodes\"\n"), {"path.watch=[]"});
  expect_confirmed(traced);
  const TracedDeck sliding(indented_arch(centimetres, 0.1, 0.05), {"path.watch=[]"});
  const double at_nodes = traced.record().points.back().monitors[1];
  EXPECT_NEAR(at_nodes, sliding.record().points.back().monitors[1], 1e-4 * at_nodes);
}

// ∂Π/∂λ of a wall is its force against the way; trapezoids of the points' forces sum to the energy.
TEST(MovingWall, DoesTheWorkOfItsForceSlow) {
  const TracedDeck traced(indented_arch(centimetres, 0.1, 0.12), {"path.max_step=0.001"});
  const auto& points = traced.record().points;
  double work = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    work += 0.5 * (points[i].monitors[1] + points[i - 1].monitors[1]) * (points[i].lambda - points[i - 1].lambda);
  EXPECT_NEAR(points.back().energy - points.front().energy, work, 1e-3 * work);
}

// A round obstacle swings up under a beam; whatever is read off it is confirmed.
TEST(MovingWall, IsConfirmedWhereItTurns) {
  const std::string swing =
      wall(
          "swing",
          R"(side = "below"; profile = { type = "circle", centre = [1.0, -1.06], radius = 1.0 }; motion = { x = -0.1, z = 0.1, rotation = 0.2, about = [0.5, 0.0] })") +
      path("step = 0.1; stop = { lambda = [-0.1, 1.0] }") + wall_monitor("moment", "swing", "moment");
  for (const std::string points : {"moving", "nodes"}) {
    const TracedDeck traced(column(centimetres, swing), {"contact.points=\"" + points + "\""});
    EXPECT_GT(traced.record().points.back().contacts, 0) << points;
    expect_confirmed(traced);
  }
}

}  // namespace arcwall::loading_test
