#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

// Order of convergence of the classic beam: 4 in displacements and limit loads, 6 on circles.
namespace arcwall {

namespace {

struct Tip {
  Vec2 displacement;
  double rotation;
};

Tip solved_tip(const test::Cantilever& cantilever, double lambda) {
  const auto structure = cantilever.structure();
  const State state = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, lambda, 40);
  return {.displacement = structure->current(state.x, 1) - structure->position(1),
          .rotation = structure->value(state.x, structure->members()[0].rotations.back().value())};
}

void expect_order(double order, const std::vector<double>& sizes, const std::vector<double>& errors) {
  EXPECT_NEAR(test::observed_order(sizes, errors), order, 0.2);
  const std::size_t n = sizes.size();
  EXPECT_NEAR(test::observed_order({sizes[n - 2], sizes[n - 1]}, {errors[n - 2], errors[n - 1]}), order, 0.2);
}

// First limit load of a model.
double first_limit_load(const std::unique_ptr<Structure>& structure, double first_step, double until) {
  TraceOptions options;
  options.step.first = first_step;
  options.landmarks.push_back(test::stop_at_lambda(until));
  Tracer tracer(*structure, test::rest(*structure), options);
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events)
      if (event.kind == EventKind::limit_point) return event.state.lambda;
  ADD_FAILURE() << "no limit point";
  return 0.0;
}

}  // namespace

// End moment m = M L/EI bends a cantilever to a circle: x/L = sin m/m, y/L = (1 − cos m)/m, θ = m; N = 0, so EA does
// not enter. Half a circle: m = π. Circles are bent with order 6, other shapes with order 4.
TEST(BeamOrder, CantileverUnderAnEndMomentConvergesWithOrderSix) {
  std::vector<double> sizes, errors;
  for (const int elements : {4, 8, 16, 32}) {
    const Tip tip = solved_tip({.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = elements, .tip_moment = 1.0}, pi);
    EXPECT_NEAR(tip.rotation, pi, 1e-10);  // exact on any mesh
    sizes.push_back(1.0 / elements);
    errors.push_back((tip.displacement - Vec2(-1.0, 2.0 / pi)).norm());
  }
  expect_order(6.0, sizes, errors);
  EXPECT_LE(errors.back(), 1e-8);
}

TEST(BeamOrder, CantileverRollsUpToTwoTurns) {
  const Tip tip = solved_tip({.EA = 1e3, .EI = 1.0, .length = 1.0, .elements = 40, .tip_moment = 1.0}, 4.0 * pi);
  EXPECT_NEAR(tip.rotation, 4.0 * pi, 1e-9);
  // Half angle of an element α = 4π/80: chords are off by 31/15120 α⁶ = 3e-8 of themselves, which cancels over whole
  // turns.
  EXPECT_LE((tip.displacement - Vec2(-1.0, 0.0)).norm(), 1e-8);
}

// Transverse tip load P L²/EI = 5, inextensible, by elliptic integrals (Mattiasson 1981): w/L, u/L, θ.
TEST(BeamOrder, CantileverUnderATransverseTipLoadConvergesWithOrderFour) {
  const Vec2 expected(-0.38762836072442987186, 0.71379152361191272809);
  const double expected_rotation = 1.2153681176116810959;
  std::vector<double> sizes, errors, rotation_errors;
  for (const int elements : {4, 8, 16, 32}) {
    // The stretch P/EA = 5e-10 is far below the errors.
    const Tip tip = solved_tip({.EA = 1e10, .EI = 1.0, .length = 1.0, .elements = elements, .tip_force = 1.0}, 5.0);
    sizes.push_back(1.0 / elements);
    errors.push_back((tip.displacement - expected).norm());
    rotation_errors.push_back(tip.rotation - expected_rotation);
  }
  expect_order(4.0, sizes, errors);
  expect_order(4.0, sizes, rotation_errors);
  EXPECT_LE(errors.back(), 1e-6);
}

// Lee's frame: 1.855672753757 by shooting with the extensible elastica (EA = 4320), confirmed by collocation to 3e-11.
TEST(BeamOrder, LimitLoadOfLeesFrameConvergesWithOrderFour) {
  std::vector<double> sizes, errors;
  for (const int elements : {10, 20, 40, 80}) {
    sizes.push_back(1.0 / elements);
    errors.push_back(first_limit_load(test::lee_frame(elements), 0.1, 3.0) - 1.855672753757);
  }
  expect_order(4.0, sizes, errors);
  EXPECT_LE(std::abs(errors.back()), 2e-8);
}

// The 215° arch with EA = 1e8: 897.294947593916 by shooting with the extensible elastica. Initially curved elements.
TEST(BeamOrder, LimitLoadOfTheDeepArchConvergesWithOrderFour) {
  std::vector<double> sizes, errors;
  for (const int elements : {8, 16, 32, 64}) {
    sizes.push_back(1.0 / elements);
    errors.push_back(first_limit_load(test::deep_arch(elements), 20.0, 1200.0) / 897.294947593916 - 1.0);
  }
  expect_order(4.0, sizes, errors);
  // Extrapolated from the last two meshes: what the next terms of the error leave.
  const double extrapolated = (16.0 * errors[3] - errors[2]) / 15.0;
  EXPECT_NEAR(extrapolated, 0.0, 1e-8);
}

}  // namespace arcwall
