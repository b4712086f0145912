#include <gtest/gtest.h>

#include <algorithm>

#include "tests/published/path_checks.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Limit points and snap-backs of Williams' toggle (Williams 1964) and Lee's frame (Lee, Manuel & Rossow 1968). The
// expected values are those of the extensible elastica, found by shooting with adaptive Taylor series; those of Lee's
// frame were confirmed by collocation to 3e-11.
namespace arcwall::frames_test {

namespace {

using test::expect_points;
using test::PathModel;
using test::traced;

PathModel lee(int elements, const test::BeamTheory& theory = {}) {
  auto structure = test::lee_frame(elements, theory);
  const TargetValue stop = test::stop_at(*structure, 2, Dof::z, -90.0);
  return {.structure = std::move(structure), .loaded = 2, .first_step = 0.1, .target_values = {stop}, .watch = true};
}

PathModel williams(int elements, const test::BeamTheory& theory = {}) {
  auto structure = test::williams_toggle(elements, theory);
  const TargetValue stop = test::stop_at(*structure, 1, Dof::z, -0.8);
  return {.structure = std::move(structure), .first_step = 2.0, .target_values = {stop}, .watch = true};
}

const std::vector<test::PathEvent> williams_points = {{EventKind::limit_point, 33.8703851779, {0.0, -0.232156872412}},
                                                      {EventKind::limit_point, 31.2817744575, {0.0, -0.391594258130}}};

const std::vector<test::PathEvent> lee_points = {
    {EventKind::limit_point, 1.855672753757, {26.880573741639, -48.735137245104}},
    {EventKind::turning_point, 1.194410418780, {61.747470374254, -61.002978851425}},
    {EventKind::turning_point, -0.438048021661, {81.229007582176, -50.746251363189}},
    {EventKind::limit_point, -0.941443155560, {90.195673535530, -58.216815328711}}};

// Flexible in shear, GA = 720·6/2.6; again by shooting.
const std::vector<test::PathEvent> lee_points_with_shear = {
    {EventKind::limit_point, 1.854655874000, {26.878701338298, -48.751058692948}},
    {EventKind::limit_point, -0.939614235717, {90.180114170564, -58.223594604971}}};

}  // namespace

TEST(WilliamsToggle, PointsOfThePathAreThoseOfTheElastica) {
  const PathModel model = williams(20);
  const test::Branch branch = traced(model);
  // Twice the differences seen, which go with h⁴: see below.
  expect_points(model, branch, williams_points, 8e-5, 2e-6);
  EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());
  expect_branch_invariants(*model.structure, branch, model.options());
}

TEST(WilliamsToggle, LimitPointsConverge) {
  for (const test::BeamTheory& theory : test::elastica_theories())
    test::expect_points_converge(theory, 8, [](int n, const auto& of) { return williams(n, of); }, williams_points,
                                 {.limit_in_lambda = 1e-9, .limit_in_displacement = 1e-7});
}

TEST(LeesFrame, PointsOfThePathAreThoseOfTheElastica) {
  const PathModel model = lee(40);
  const test::Branch branch = traced(model);
  expect_points(model, branch, lee_points, 6e-7, 6e-6);
  const auto limits = events_of(branch, EventKind::limit_point);
  EXPECT_EQ(limits.at(0).unstable_before, 0);
  EXPECT_EQ(limits.at(0).unstable_after, 1);
  EXPECT_EQ(limits.at(1).unstable_after, 0);
  expect_branch_invariants(*model.structure, branch, model.options());
}

TEST(LeesFrame, LimitPointsAndSnapBacksConverge) {
  for (const test::BeamTheory& theory : test::elastica_theories())
    test::expect_points_converge(theory, 10, [](int n, const auto& of) { return lee(n, of); }, lee_points,
                                 {.limit_in_lambda = 1e-8, .limit_in_displacement = 1e-7});
  for (const test::BeamTheory& theory : test::shear_theories())
    test::expect_points_converge(theory, 10, [](int n, const auto& of) { return lee(n, of); }, lee_points_with_shear,
                                 {.limit_in_lambda = 1e-7, .limit_in_displacement = 1e-7});
}

// However long the steps may grow, the same four points are found, to the precision of their localisation.
TEST(LeesFrame, AnyGreatestStepFindsTheSameFourPointsSlow) {
  const double greatest[] = {0.1, 0.14, 0.2, 0.27, 0.37, 0.5, 0.7, 1.0, 1.3, 1.8, 2.4, 3.1, 4.0};
  for (const int elements : {20, 200}) {
    const PathModel model = lee(elements);
    std::vector<Event> first;
    for (const double max : greatest) {
      SCOPED_TRACE(std::to_string(elements) + " elements, max " + std::to_string(max));
      TraceOptions options = model.options();
      options.step.max = max;
      const test::Branch branch = test::trace(*model.structure, options, model.watched());
      EXPECT_EQ(branch.end.reason, EndReason::stop);
      expect_points(model, branch, lee_points, 8e-6, 1e-4);
      std::vector<Event> events = events_of(branch);
      if (first.empty()) first = events;
      ASSERT_EQ(events.size(), first.size());
      for (std::size_t i = 0; i < events.size(); ++i) {
        EXPECT_EQ(events[i].kind, first[i].kind);
        EXPECT_NEAR(events[i].state.lambda, first[i].state.lambda, 1e-8);
      }
    }
  }
}

}  // namespace arcwall::frames_test
