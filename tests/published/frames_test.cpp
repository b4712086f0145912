#include <gtest/gtest.h>

#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Limit points and snap-backs of Williams' toggle, Lee's frame and the 215° arch. The expected values are those of the
// extensible elastica, found by shooting with adaptive Taylor series and confirmed by collocation to 3e-11. The meshes
// here are off by c h⁴; the tolerances are about twice the differences seen, of which the order tests show that they
// shrink as h⁴.
namespace arcwall {

namespace {

using test::trace;

struct Point {
  EventKind kind;
  double lambda, ux, uz;
};

struct Model {
  std::unique_ptr<Structure> structure;
  Index loaded;
  double first_step;
  Landmark stop;
};

test::Branch traced(const Model& model, TraceOptions& options) {
  options.step.first = model.first_step;
  options.landmarks = {model.stop};
  return trace(
      *model.structure, options,
      std::vector<Watch>{{.quantity = test::displacement(*model.structure, model.loaded, Freedom::z), .label = "w"}});
}

// The events of the two kinds in their order, against the expected ones.
void expect_points(const Model& model, const test::Branch& branch, const std::vector<Point>& expected, double in_lambda,
                   double in_displacement) {
  std::vector<Event> found = events_of(branch);
  std::erase_if(found, [](const Event& event) {
    return event.kind != EventKind::limit_point && event.kind != EventKind::displacement_limit;
  });
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].state.lambda, expected[i].lambda, in_lambda);
    const Vec2 u = model.structure->current(found[i].state.x, model.loaded) - model.structure->position(model.loaded);
    EXPECT_NEAR(u.x(), expected[i].ux, in_displacement);
    EXPECT_NEAR(u.y(), expected[i].uz, in_displacement);
  }
}

Model lee(int elements, const test::BeamTheory& beam = {}) {
  auto structure = test::lee_frame(elements, beam);
  const auto w = test::displacement(*structure, 2, Freedom::z);
  return {.structure = std::move(structure),
          .loaded = 2,
          .first_step = 0.1,
          .stop = {.quantity = w, .value = -90.0, .stops = true, .label = "w"}};
}

const std::vector<Point> lee_points = {
    {EventKind::limit_point, 1.855672753757, 26.880573741639, -48.735137245104},
    {EventKind::displacement_limit, 1.194410418780, 61.747470374254, -61.002978851425},
    {EventKind::displacement_limit, -0.438048021661, 81.229007582176, -50.746251363189},
    {EventKind::limit_point, -0.941443155560, 90.195673535530, -58.216815328711}};

}  // namespace

TEST(WilliamsToggle, LimitLoadsAreThoseOfTheElastica) {
  auto structure = test::williams_toggle(20);
  const auto w = test::displacement(*structure, 1, Freedom::z);
  const Model model{.structure = std::move(structure),
                    .loaded = 1,
                    .first_step = 2.0,
                    .stop = {.quantity = w, .value = -0.8, .stops = true, .label = "w"}};
  TraceOptions options;
  const test::Branch branch = traced(model, options);
  expect_points(model, branch,
                {{EventKind::limit_point, 33.8703851779, 0.0, -0.232156872412},
                 {EventKind::limit_point, 31.2817744575, 0.0, -0.391594258130}},
                8e-5, 2e-6);
  expect_branch_invariants(*model.structure, branch, options);
}

TEST(LeesFrame, LimitPointsAndSnapBacksAreThoseOfTheElastica) {
  const Model model = lee(40);
  TraceOptions options;
  const test::Branch branch = traced(model, options);
  expect_points(model, branch, lee_points, 6e-7, 6e-6);
  const auto limits = events_of(branch, EventKind::limit_point);
  EXPECT_EQ(limits.at(0).unstable_before, 0);
  EXPECT_EQ(limits.at(0).unstable_after, 1);
  EXPECT_EQ(limits.at(1).unstable_after, 0);
  expect_branch_invariants(*model.structure, branch, options);
}

// Half of the elements, and a thousandth of the differences for order 6.
TEST(LeesFrame, ElasticaBeamsGiveTheSamePoints) {
  struct Case {
    int order;
    double in_lambda, in_displacement;
  };
  for (const Case& c : {Case{.order = 4, .in_lambda = 2e-5, .in_displacement = 2e-4},
                        Case{.order = 6, .in_lambda = 5e-9, .in_displacement = 5e-8}}) {
    SCOPED_TRACE(c.order);
    const Model model = lee(20, {.theory = Theory::elastica, .order = c.order});
    TraceOptions options;
    const test::Branch branch = traced(model, options);
    expect_points(model, branch, lee_points, c.in_lambda, c.in_displacement);
    expect_branch_invariants(*model.structure, branch, options);
  }
}

TEST(DeepArch, LimitPointsAndSnapBacksAreThoseOfTheElastica) {
  auto structure = test::deep_arch(32);
  const Model model{
      .structure = std::move(structure), .loaded = 1, .first_step = 20.0, .stop = test::stop_at_lambda(1200.0)};
  TraceOptions options;
  const test::Branch branch = traced(model, options);
  expect_points(model, branch,
                {{EventKind::limit_point, 897.294947593916, -61.141688374665, -113.730829640612},
                 {EventKind::displacement_limit, 559.219378191646, -64.963819621710, -120.388749570584},
                 {EventKind::displacement_limit, 8.711863197127, -61.064543757440, -118.479972180842},
                 {EventKind::limit_point, -73.051143418756, -57.067750595019, -122.065270509795}},
                3.5e-3, 8e-5);
  expect_branch_invariants(*model.structure, branch, options);
}

// However long the steps may grow, the same four points are found, to the precision of their localisation.
TEST(LeesFrame, AnyGreatestStepFindsTheSameFourPointsSlow) {
  const double greatest[] = {0.1, 0.14, 0.2, 0.27, 0.37, 0.5, 0.7, 1.0, 1.3, 1.8, 2.4, 3.1, 4.0};
  for (const int elements : {20, 200}) {
    const Model model = lee(elements);
    std::vector<Event> first;
    for (const double max : greatest) {
      SCOPED_TRACE(std::to_string(elements) + " elements, max " + std::to_string(max));
      TraceOptions options;
      options.step.max = max;
      const test::Branch branch = traced(model, options);
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

}  // namespace arcwall
