#include <gtest/gtest.h>

#include <cmath>

#include "tests/published/path_checks.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/explore.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Circular arches under a load on their crown. The expected values are those of the elastica, found by shooting with
// adaptive Taylor series; those of the 215° arch and of the semicircle with R = 127 were confirmed by collocation.
namespace arcwall::arches_test {

namespace {

using test::BeamTheory;
using test::CircularArch;
using test::expect_points;
using test::Graph;
using test::PathEvent;
using test::PathModel;
using test::traced;

PathModel path_of(std::unique_ptr<Structure> arch, double first_step, double lowest) {
  const TargetValue stop = test::stop_at(*arch, 1, Dof::z, lowest);
  return {.structure = std::move(arch), .first_step = first_step, .target_values = {stop}};
}

PathModel deep(int elements, const BeamTheory& beam) {
  return {.structure = test::deep_arch(elements, beam),
          .first_step = 20.0,
          .target_values = {test::stop_at_lambda(1200.0)},
          .watch = true};
}

PathModel semicircle(int elements, const BeamTheory& beam = {}) {
  return path_of(test::pinned_semicircle(elements, beam), 1.0, -150.0);
}

PathModel shallow(int elements, const BeamTheory& beam = {}) {
  return path_of(test::shallow_arch(elements, beam), 60.0, -1050.0);
}

// Both branches of an arch that sways; of mirror images that on which the crown goes to the right.
Graph swaying(const PathModel& arch, double to_the_right = 1.0) {
  const auto u = test::displacement(*arch.structure, 1, Dof::x);
  return test::explore(
      *arch.structure, arch.options(),
      {.policy = BranchPolicy::all, .depth = 1, .preference = {std::make_shared<ScaledObservable>(u, to_the_right)}});
}

// R = EI = 1: the limit 1/EA → 0 of one λ of an arch's graph.
double inextensible(const CircularArch& arch, double lowest, const std::function<double(const Graph&)>& lambda) {
  return test::at_zero(
      [&](double flexibility) {
        CircularArch extensible = arch;
        extensible.EA = 1.0 / flexibility;
        return lambda(swaying(path_of(extensible.structure(), 0.2, lowest)));
      },
      4e-5);
}

double lambda_of(const Graph& graph, std::size_t branch, EventKind kind, std::size_t number = 0) {
  if (branch >= graph.branches.size()) {
    ADD_FAILURE() << "no branch " << branch;
    return 0.0;
  }
  const auto events = events_of(graph.branches[branch], kind);
  EXPECT_GT(events.size(), number);
  return events.size() > number ? events[number].state.lambda : 0.0;
}

const std::vector<PathEvent> deep_points = {
    {EventKind::limit_point, 897.294947593916, {-61.141688374665, -113.730829640612}},
    {EventKind::turning_point, 559.219378191646, {-64.963819621710, -120.388749570584}},
    {EventKind::turning_point, 8.711863197127, {-61.064543757440, -118.479972180842}},
    {EventKind::limit_point, -73.051143418756, {-57.067750595019, -122.065270509795}}};

const std::vector<PathEvent> shallow_points = {
    {EventKind::limit_point, 1280.6066372817945, {0.0, -283.686961141311}},
    {EventKind::branch_point, 1279.3630853648895, {0.0, -293.892593560182}},
    {EventKind::limit_point, -477.9940676356999, {0.0, -800.4744667932501}},
    {EventKind::branch_point, -435.9599575500913, {0.0, -841.7028839339018}}};

const std::vector<PathEvent> semicircle_points = {
    {EventKind::branch_point, 20.842078650280854, {0.0, -24.745526091339578}},
    {EventKind::limit_point, 36.088865930117144, {0.0, -92.94284735332394}}};

}  // namespace

// DaDeppo & Schmidt 1975 give the first limit load of the inextensible arch as 8.97 EI/R², 897 here.
TEST(DeepArch, PointsOfThePathAreThoseOfTheElastica) {
  const PathModel model = deep(32, {});
  const test::Branch branch = traced(model);
  // Twice the differences seen, which go with h⁴: see below.
  expect_points(model, branch, deep_points, 3.5e-3, 8e-5);
  EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());
  expect_branch_invariants(*model.structure, branch, model.options());
}

TEST(DeepArch, LimitPointsAndSnapBacksConverge) {
  const auto model = [](int n, const auto& of) { return deep(n, of); };
  // The slopes whose zeros are the snap-backs are known to 1e-8, their places to 4e-9: an order within 0.2 can be read
  // from errors of seven times that.
  const test::Precision precision{.limit_in_lambda = 1e-7, .limit_in_displacement = 1e-7, .noise = 3e-8};
  test::expect_points_converge({}, 8, model, deep_points, precision);
  // With the elastica the snap-backs come down to their round-off before they show their order.
  std::vector<test::PathEvent> limits = deep_points;
  std::erase_if(limits, [](const test::PathEvent& point) { return point.kind != EventKind::limit_point; });
  for (const BeamTheory& theory : test::elastica_theories())
    test::expect_points_converge(theory, 8, model, limits, precision);
}

// GA → ∞ by extrapolation: a GA so large that it does not matter would leave its round-off in the forces.
TEST(DeepArch, LimitLoadConvergesForBeamsFlexibleInShear) {
  for (const BeamTheory& theory : test::shear_theories()) {
    SCOPED_TRACE(theory.name);
    const auto limits = test::on_four_meshes(8, [&](int elements) {
      const auto limit_load = [&](double flexibility) {
        const PathModel model = path_of(test::deep_arch(elements, theory, 1.0 / flexibility), 20.0, -114.5);
        return events_of(traced(model), EventKind::limit_point).at(0).state.lambda;
      };
      return test::at_zero(limit_load, 1e-7);
    });
    test::expect_convergence(limits, {.exact = 897.294947593916, .order = double(theory.convergence)});
  }
}

TEST(ShallowArch, BranchPointsFollowTheLimitPoints) {
  const PathModel model = shallow(48);
  const test::Branch branch = traced(model);
  // c h⁴ with 48 elements a half: 1e-8 relative was seen, half of the tolerance.
  expect_points(model, branch, shallow_points, 1280.0 * 4e-8, 850.0 * 4e-8);
  for (const Event& event : events_of(branch, EventKind::branch_point))
    EXPECT_EQ(event.branching->type, BranchType::pitchfork);
  expect_branch_invariants(*model.structure, branch, model.options());
}

TEST(ShallowArch, LimitAndBranchPointsConverge) {
  for (const BeamTheory& theory : test::elastica_theories())
    test::expect_points_converge(theory, 8, [](int n, const auto& of) { return shallow(n, of); }, shallow_points,
                                 {.limit_in_lambda = 1e-9, .limit_in_displacement = 1e-8});
}

// The branch on which the arch sways joins both branch points of the first; λ and sway where the crown is this far
// down, by shooting.
TEST(ShallowArch, TheSecondBranchIsThatOfTheElasticaAndJoinsBothBranchPoints) {
  PathModel model = shallow(48);
  struct Sample {
    double w, lambda, u;
  };
  const Sample samples[] = {{-300.0, 1260.2009713399655, 4.016304438364473},
                            {-400.0, 946.5534625041453, 11.326301117471244},
                            {-600.0, 319.9530425641985, 4.800776337205812},
                            {-800.0, -305.643367241316, -2.4543188368638953}};
  for (const Sample& sample : samples)
    model.target_values.push_back({.quantity = test::displacement(*model.structure, 1, Dof::z), .value = sample.w});
  const Graph graph = swaying(model);
  ASSERT_EQ(graph.records.size(), 2U);
  EXPECT_TRUE(graph.records[1].mirror_image);
  EXPECT_EQ(graph.branches[1].end.reason, EndReason::reached_branch);
  EXPECT_TRUE(events_of(graph.branches[1], EventKind::branch_point).empty());
  EXPECT_TRUE(events_of(graph.branches[1], EventKind::limit_point).empty());
  std::size_t met = 0;
  for (const Arc& arc : graph.branches[1].arcs)
    for (const Sample& sample : samples) {
      const Vec2 moved = test::displacement_of(*model.structure, arc.to.state, 1);
      if (std::abs(moved.y() - sample.w) > 1e-8) continue;
      ++met;
      EXPECT_NEAR(arc.to.state.lambda, sample.lambda, 1280.0 * 1e-7);
      EXPECT_NEAR(moved.x(), sample.u, 850.0 * 1e-7);
    }
  EXPECT_EQ(met, std::size(samples));
}

TEST(PinnedSemicircle, SwaysBeforeItsLimitPointToBothSidesAlike) {
  const PathModel model = semicircle(48);
  const Graph to_the_right = swaying(model), to_the_left = swaying(model, -1.0);
  for (const Graph* graph : {&to_the_right, &to_the_left}) {
    ASSERT_EQ(graph->records.size(), 2U);
    EXPECT_TRUE(graph->records[1].mirror_image);
    EXPECT_EQ(graph->records[1].parent, 0);
    // c h⁴ with 48 elements a half: 6e-8 relative was seen, half of the tolerance.
    expect_points(model, graph->branches[0], semicircle_points, 36.0 * 1.2e-7, 93.0 * 1.2e-7);
    EXPECT_EQ(events_of(graph->branches[0], EventKind::branch_point).at(0).branching->type, BranchType::pitchfork);
    const double side = graph == &to_the_right ? 1.0 : -1.0;
    expect_points(model, graph->branches[1],
                  {{EventKind::limit_point, 27.6290182852711, {side * 66.6164258550, -92.3234990050}}}, 27.63 * 1.2e-7,
                  1e-3);
  }
}

TEST(PinnedSemicircle, BranchAndLimitPointsConvergeSlow) {
  for (const BeamTheory& theory : test::elastica_theories()) {
    test::expect_points_converge(theory, 8, [](int n, const auto& of) { return semicircle(n, of); }, semicircle_points,
                                 {.limit_in_lambda = 1e-8, .limit_in_displacement = 1e-7});
    const auto limit = test::on_four_meshes(
        8, [&](int elements) { return lambda_of(swaying(semicircle(elements, theory)), 1, EventKind::limit_point); });
    test::expect_convergence(limit, {.exact = 27.6290182852711, .order = double(theory.convergence)});
  }
}

// R = EI = 1, inextensible: 1/EA → 0 by extrapolation.
TEST(PinnedSemicircle, BranchAndLimitPointsOfTheInextensibleArchSlow) {
  for (const BeamTheory& theory : test::elastica_theories()) {
    struct Expected {
      std::size_t branch;
      EventKind kind;
      double lambda;
    };
    for (const Expected& expected : {Expected{0, EventKind::branch_point, 5.860537634339936},
                                     Expected{0, EventKind::limit_point, 10.150343863669443},
                                     Expected{1, EventKind::limit_point, 7.771343814089118}}) {
      const auto values = test::on_four_meshes(4, [&](int elements) {
        return inextensible({.elements = elements, .beam = theory}, -1.1,
                            [&](const Graph& graph) { return lambda_of(graph, expected.branch, expected.kind); });
      });
      test::expect_convergence(values, {.exact = expected.lambda, .order = double(theory.convergence)});
    }
  }
}

// The same, clamped: it reaches its limit points without swaying.
TEST(ClampedSemicircle, LimitPointsOfTheInextensibleArchSlow) {
  for (const BeamTheory& theory : test::elastica_theories())
    for (const std::size_t number : {0U, 1U}) {
      const double exact = number == 0 ? 10.457262701909803 : 4.510753685275968;
      const auto values = test::on_four_meshes(8, [&](int elements) {
        const CircularArch arch{.clamped_left = true, .clamped_right = true, .elements = elements, .beam = theory};
        return inextensible(arch, -1.5, [&](const Graph& graph) {
          const auto sway = events_of(graph.branches[0], EventKind::branch_point);
          for (const Event& event : sway)
            EXPECT_GT(event.arc, events_of(graph.branches[0], EventKind::limit_point).at(0).arc);
          return lambda_of(graph, 0, EventKind::limit_point, number);
        });
      });
      test::expect_convergence(values, {.exact = exact, .order = double(theory.convergence)});
    }
}

}  // namespace arcwall::arches_test
