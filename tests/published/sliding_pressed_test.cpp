#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/sliding_models.hpp"

// Parts of a beam that are pressed on a wall over a length: they lift off inside and lie down again, and wrap a
// cylinder. References are the extensible elastica between its contacts, θ′ = κ₀ + M/EI, (x′, z′) = (1 + N/EA)(cos θ,
// sin θ), M′ = −(1 + N/EA) Q, integrated with Runge-Kutta's method, the ends of the parts being unknowns besides the
// forces (Newton); all digits given stay with half the steps.
namespace arcwall::sliding_pressed_test {

namespace {

using test::ExploredBranch;
using test::SlidingChannel;
using test::SlidingCylinder;
using test::SlidingModel;

constexpr auto opens = EventKind::contact_opens, closes = EventKind::contact_closes,
               spreads = EventKind::contact_spreads, splits = EventKind::contact_splits,
               shrinks = EventKind::contact_shrinks, merge = EventKind::contacts_merge;

struct Path : test::SlidingPath {
  Vector points() const { return last().x.tail(mesh_of(last()).breakpoints()); }
};

Path path_of(SlidingModel model, double to, double step = 0.05) {
  return {test::sliding_path(std::move(model), to, step)};
}

// From the end of a path back.
std::vector<ExploredBranch> unloaded(const Path& path, double to) {
  TraceOptions options = path.options;
  options.step.first *= -1.0;
  options.target_values = {test::stop_at_lambda(to)};
  return test::follow(path.model.system(), path.last(), options);
}

// The channel's column with a half sine and a third harmonic, on the upper wall alone.
SlidingChannel bent_column(int elements, Theory theory, double third, double lateral = 0.0) {
  return {.members = {{2.0, elements}},
          .imperfection = {{.amplitude = 0.00176}, {.amplitude = third, .waves = 3}},
          .lower = std::nullopt,
          .lateral = lateral,
          .theory = theory};
}

// Of errors on meshes each half as coarse as the one before.
double order(const std::vector<double>& errors, std::size_t finer) {
  return std::log2(std::abs(errors[finer - 1] / errors[finer]));
}

class SlidingPressedPart : public ::testing::TestWithParam<Theory> {};

INSTANTIATE_TEST_SUITE_P(Theories, SlidingPressedPart, ::testing::Values(Theory::euler_bernoulli, Theory::elastica),
                         [](const auto& theory) {
                           return theory.param == Theory::euler_bernoulli ? "Classic" : "Elastica";
                         });

}  // namespace

// A load that pulls the column off the wall. On the flat wall the pressure is EI κ₀″/(1 − P/EA) − 1.5·10⁻⁴ P, least in
// the middle, with κ₀″ = −y⁗ + 3 y″³ there: it vanishes at P = 3.945344896566. At P = 6 the free stretch in the middle
// reaches from 0.597779134756 on.
TEST_P(SlidingPressedPart, LiftsOffInside) {
  std::vector<double> loads, edges;
  for (const int elements : {10, 20, 40}) {
    const Path path = path_of(bent_column(elements, GetParam(), 1.5e-5, -1.5e-4).model(), 6.0);
    ASSERT_EQ(path.kinds(), (std::vector{closes, spreads, splits}));
    const Event event = path.events()[2];
    EXPECT_NEAR(path.model.system().contact(event.state, event.guards[0]).label.fraction, 0.5, 1e-7);
    ASSERT_EQ(path.points().size(), 4);
    EXPECT_NEAR(path.points()[1] + path.points()[2], 2.0, 1e-7);
    loads.push_back(event.state.lambda / 3.945344896566 - 1.0);
    edges.push_back(path.points()[1] / 0.597779134756 - 1.0);
    if (elements == 40) path.expect_invariants();
  }
  for (const std::size_t finer : {1U, 2U}) EXPECT_GE(order(edges, finer), 3.6);
  for (const double load : loads) EXPECT_LE(std::abs(load), 1e-9);  // no mesh is in the pressure on a straight wall
  EXPECT_LE(std::abs(edges[2]), 1e-5);
}

// With this third harmonic the pressure falls to zero where the part ends, when it reaches κ₀″ = 0 at 0.501971: at P =
// 6.809759886725. Behind it the part's end stays as a point contact. At P = 10 that is at 0.412310607085 and bears
// 4.359188153009, and the part begins at 0.55973536. The load changes by 30 for a change of the part's end by 1.
TEST_P(SlidingPressedPart, LiftsOffAtItsEnds) {
  std::vector<double> loads, points, edges, forces;
  for (const int elements : {20, 40, 80}) {
    const Path path = path_of(bent_column(elements, GetParam(), -2.2e-5).model(), 10.0);
    ASSERT_EQ(path.kinds(), (std::vector{closes, spreads, splits}));
    const Event event = path.events()[2];
    EXPECT_EQ(event.guards.size(), 2U);  // both ends
    ASSERT_EQ(path.points().size(), 4);
    loads.push_back(event.state.lambda / 6.809759886725 - 1.0);
    points.push_back(path.points()[0] / 0.412310607085 - 1.0);
    edges.push_back(path.points()[1] / 0.55973536 - 1.0);
    forces.push_back(path.force(0) / 4.359188153009 - 1.0);
    if (elements == 80) path.expect_invariants();
  }
  for (const std::size_t finer : {1U, 2U}) {
    EXPECT_NEAR(order(points, finer), 4.0, 0.1);
    EXPECT_NEAR(order(forces, finer), 4.0, 0.1);
    EXPECT_NEAR(order(loads, finer), 4.0, 0.1);
  }
  EXPECT_GE(order(edges, 2), 3.8);  // of the 20 elements the error has another sign at first
  EXPECT_LE(std::abs(loads[1]), 1e-6);
  EXPECT_LE(std::abs(loads[2]), 1e-7);
  EXPECT_LE(std::abs(points[2]), 5e-8);
  EXPECT_LE(std::abs(edges[2]), 1e-6);
}

// Unloaded, the free stretch closes at the load of its opening, and the part shrinks at the load at which it spread.
TEST_P(SlidingPressedPart, LiesDownAgain) {
  const Path path = path_of(bent_column(20, GetParam(), 1.5e-5, -1.5e-4).model(), 6.0);
  const auto loading = path.events(), unloading = test::events_of(unloaded(path, 0.2));
  ASSERT_EQ(unloading.size(), 3U);
  EXPECT_EQ(unloading[0].kind, merge);
  EXPECT_NEAR(unloading[0].state.lambda, 3.945344896566, 2e-5 * 3.9);
  EXPECT_NEAR(path.model.system().contact(unloading[0].state, unloading[0].guards[0]).label.fraction, 0.5, 1e-7);
  EXPECT_EQ(unloading[1].kind, shrinks);
  EXPECT_NEAR(unloading[1].state.lambda, loading[1].state.lambda, 1e-9 * loading[1].state.lambda);
  EXPECT_EQ(unloading[2].kind, opens);
  EXPECT_NEAR(unloading[2].state.lambda, loading[0].state.lambda, 1e-9 * loading[0].state.lambda);
}

// The strip of the example `cylinder`: the point contact has the curvature of the wall at 0.225270998862; at 1 the part
// that is wrapped reaches from 5.591291491879 to 15.129810332531, with 0.226994079598 and 0.244765017420 concentrated
// at its ends. What a node at an end bears is that and the pressure of half an element.
TEST_P(SlidingPressedPart, WrapsACylinder) {
  std::vector<double> loads, first, last, first_force, last_force;
  for (const int elements : {10, 20, 40, 80}) {
    const Path path = path_of(SlidingCylinder{.elements = elements, .theory = GetParam()}.model(), 1.0, 0.01);
    ASSERT_EQ(path.kinds(), (std::vector{closes, spreads}));
    path.expect_invariants();
    loads.push_back(path.events()[1].state.lambda / 0.225270998862 - 1.0);
    first.push_back(path.points()[0] / 5.591291491879 - 1.0);
    last.push_back(path.points()[1] / 15.129810332531 - 1.0);
    const State& state = path.last();
    const Index closed = state.active_set.closed_count(),
                held = path.model.system().multiplier_count(state.active_set) - closed - 2;
    const Vector inside = state.x.segment(mesh_of(state).unknowns() + closed, held);
    first_force.push_back((path.force(0) - 0.5 * inside[0]) / 0.226994079598 - 1.0);
    last_force.push_back((path.force(1) - 0.5 * inside[held - 1]) / 0.244765017420 - 1.0);
  }
  for (const std::size_t finer : {1U, 2U, 3U})
    for (const auto& errors : {loads, first, last}) EXPECT_GE(order(errors, finer), 3.9);
  for (const auto& errors : {loads, first, last}) EXPECT_LE(std::abs(errors[3]), 5e-9);
  for (const auto& errors : {first_force, last_force}) {
    EXPECT_NEAR(order(errors, 3), 2.0, 0.1);
    EXPECT_LE(std::abs(errors[3]), 2e-6);
  }
}

// A flat part shrinks where it spread, too.
TEST(SlidingFlatPart, GathersWhereItSpread) {
  const Path path = path_of(test::SlidingFoundation{.elements = 20}.model(), 5.0, 0.1);
  ASSERT_EQ(path.kinds(), (std::vector{closes, spreads}));
  const auto loading = path.events(), unloading = test::events_of(unloaded(path, 0.1));
  ASSERT_EQ(unloading.size(), 2U);
  EXPECT_EQ(unloading[0].kind, shrinks);
  EXPECT_NEAR(unloading[0].state.lambda, loading[1].state.lambda, 1e-9 * loading[1].state.lambda);
  EXPECT_EQ(unloading[1].kind, opens);
  EXPECT_NEAR(unloading[1].state.lambda, loading[0].state.lambda, 1e-9 * loading[0].state.lambda);
}

namespace {

// A leaf of length 1 (EI = 1, EA = 1e5), clamped on a cylinder of radius 1 and tangentially to it, with the load λ on
// its tip. It runs from the clamp, or towards it.
SlidingModel leaf_on_cylinder(int elements, Theory theory, bool reversed) {
  auto [builder, clamped, free] = test::clamped_member({0.0, 0.0}, {1.0, 0.0}, reversed,
                                                       {.name = "leaf",
                                                        .theory = theory,
                                                        .order = theory == Theory::elastica ? 6 : 2,
                                                        .section = {.E = 1.0, .A = 1e5, .I = 1.0, .height = 0.01},
                                                        .elements = elements});
  builder.add_load(builder.dof(free, Dof::z), -1.0, LoadKind::proportional);
  return {builder,
          {{.name = "cylinder",
            .side = Side::below,
            .profile = circle_profile({0.0, -1.0}, 1.0, Side::below),
            .on_axis = true}},
          0.05};
}

}  // namespace

// The leaf touches the cylinder at its clamp alone until the moment there is EI/R, at a load of 1.0672281847. It then
// lies on it from the clamp on, at loads of 2 and 4 up to 0.3952437117 and 0.6526673821.
TEST_P(SlidingPressedPart, GrowsFromAClamp) {
  for (const auto& [load, edge] : {std::pair(2.0, 0.3952437117), std::pair(4.0, 0.6526673821)}) {
    std::vector<double> begins, edges;
    for (const int elements : {20, 40, 80}) {
      const Path path = path_of(leaf_on_cylinder(elements, GetParam(), false), load);
      ASSERT_EQ(path.kinds(), std::vector{spreads});
      const Event event = path.events()[0];
      EXPECT_EQ(path.model.system().contact(event.state, event.guards[0]).label.fraction, 0.0);
      begins.push_back(event.state.lambda / 1.0672281846885918 - 1.0);
      edges.push_back(path.points()[0] / edge - 1.0);
      if (elements == 80) path.expect_invariants();
      if (elements > 20) continue;
      const Path mirrored = path_of(leaf_on_cylinder(elements, GetParam(), true), load);
      ASSERT_EQ(mirrored.kinds(), std::vector{spreads});
      EXPECT_NEAR(1.0 - mirrored.points()[0], path.points()[0], 1e-8);
      const std::vector<Event> back = test::events_of(unloaded(path, 0.5));
      ASSERT_EQ(back.size(), 1U);
      EXPECT_EQ(back[0].kind, shrinks);
      EXPECT_NEAR(back[0].state.lambda, event.state.lambda, 1e-6);
    }
    EXPECT_LE(std::abs(begins.back()), 1e-9);
    for (const double error : edges) EXPECT_LE(std::abs(error), 1e-8);
  }
}

}  // namespace arcwall::sliding_pressed_test
