#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/sliding_models.hpp"

// Contact with surfaces that are smaller than an element. The reference is the extensible elastica, θ′ = M/EI, (x′, z′)
// = (1 + N/EA)(cos θ, sin θ), M′ = (1 + N/EA) F cos θ, integrated with Runge-Kutta's method from the clamp to the touch
// and on to the tip, where M = 0; λ, the clamp's moment and the touch are unknowns (Newton). All digits given stay with
// half the steps.
namespace arcwall {

namespace {

constexpr double length = 1.3, half_height = 0.01;

// A cantilever of section 0.04 × 0.02 and E = 21000 whose tip is pulled down by 3.3e-4 λ, and what is below it.
test::SlidingModel above(std::shared_ptr<const Profile> profile, int elements) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(length, 0.0);
  const Index clamp = builder.add_joint(a), tip = builder.add_joint(b);
  builder.add_member({.name = "strip",
                      .from = clamp,
                      .to = tip,
                      .axis = straight_axis(a, b),
                      .order = 4,
                      .section = {.E = 21000.0, .A = 8e-4, .I = 0.04 * 8e-6 / 12.0, .height = 2.0 * half_height},
                      .elements = elements});
  for (const Dof dof : {Dof::x, Dof::z}) builder.fix(builder.dof(clamp, dof));
  builder.fix(builder.shared_rotation(clamp).value());
  builder.add_load(builder.dof(tip, Dof::z), -3.3e-4, LoadKind::proportional);
  return {builder, {{.name = "peg", .side = Side::below, .profile = std::move(profile)}}, 0.1};
}

std::vector<test::ExploredBranch> bent(const test::SlidingModel& model, double first_step = 0.1) {
  TraceOptions options;
  options.step.first = first_step;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(2.0)};
  return test::follow(model.system(), model.system().rest(), options);
}

std::shared_ptr<const Profile> peg(double radius) {
  return circle_profile({0.66, -0.103 - radius}, radius, Side::below);
}

}  // namespace

class Pegs : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Elements, Pegs, ::testing::Values(8, 10, 14, 20, 40, 80, 160));

// The axis is 0.02 from the peg's centre at (0.66, −0.113) when λ = 0.677821117378, at 0.5178978555 of the length.
TEST_P(Pegs, AreTouchedAtOneLoadOnAllMeshes) {
  const test::SlidingModel model = above(peg(0.01), GetParam());
  const auto branches = bent(model);
  const Event touch = test::event_of(branches, EventKind::contact_closes);
  const double error_of_eight = 2e-9;  // of the elements, measured; it falls with the fourth power
  EXPECT_NEAR(touch.state.lambda, 0.677821117378, error_of_eight);
  EXPECT_NEAR(model.system().contact(touch.state, touch.guards.front()).label.fraction, 0.5178978555, 1e-7);
  EXPECT_EQ(branches.back().record.end->reason, EndReason::stop);
  EXPECT_GE(model.system().least_gap(branches.back().arcs.back().to.state, 16), -1e-7);
}

// A peg that is smaller than a thousandth of an element, and steps that are long: it is not jumped over.
TEST(SmallPegs, AreTouchedHoweverSmallTheyAreAndHoweverLongTheSteps) {
  for (const double radius : {1e-3, 1e-4, 1e-5})
    for (const double step : {0.05, 0.5}) {
      const test::SlidingModel model = above(peg(radius), 12);
      const auto branches = bent(model, step);
      const Event touch = test::event_of(branches, EventKind::contact_closes);
      const SlidingMesh& mesh = mesh_of(touch.state);
      const AxisPlace at = mesh.node(0, mesh.breakpoint(0).second, mesh_state_of(touch.state));
      EXPECT_NEAR((at.position - Vec2(0.66, -0.103 - radius)).norm(), radius + half_height, 1e-9);
    }
}

// A spline with a bump that is narrower than an element, between places where the strip's nodes face its valleys.
TEST(SmallPegs, AreSeenAsBumpsOfASpline) {
  std::vector<double> x, z;
  for (int i = -40; i <= 40; ++i) {
    x.push_back(0.66 + 0.004 * i);
    z.push_back(-0.3 + 0.197 * std::exp(-std::pow(i / 3.0, 2)));
  }
  const std::shared_ptr<const Profile> bump = spline_profile(x, z);
  std::vector<double> loads;
  for (const int elements : {8, 16, 64}) {
    const test::SlidingModel model = above(bump, elements);
    loads.push_back(test::event_of(bent(model), EventKind::contact_closes).state.lambda);
  }
  EXPECT_NEAR(loads[0], loads[2], 1e-8);
  EXPECT_NEAR(loads[1], loads[2], 1e-8);
}

}  // namespace arcwall
