#include "continuation/step/path_constraint.hpp"

#include <gtest/gtest.h>

#include "core/derivative_check.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::path_constraint_test {

namespace {

using Form = SphereConstraint::Form;

const Metric metric(Vector{{0.5, 2.0}}, 4.0);
const State origin{.x = Vector{{1.0, -1.0}}, .lambda = 0.5};
const Direction tangent = unit(metric, {.dx = Vector{{1.0, 0.4}}, .dlambda = 2.0});
const State nearby{.x = Vector{{1.3, -0.8}}, .lambda = 0.9};

// The first unknown.
struct First final : Observable {
  double value(const State& s) const override { return s.x[0]; }
  Row gradient(const State& s) const override { return {.dx = Vector::Unit(s.x.size(), 0), .dlambda = 0.0}; }
};
const First first;

// The line through two vectors, whose columns are others.
EquilibriumLine line_of(const Direction& particular, const Direction& along) {
  EquilibriumLine line{.dx = Matrix(2, 2), .off = 0.3, .scale = 0.5};
  line.dx.col(1) = along.dx / line.scale;
  line.dx.col(0) = particular.dx + line.off * line.dx.col(1);
  line.dlambda[1] = along.dlambda / line.scale;
  line.dlambda[0] = particular.dlambda + line.off * line.dlambda[1];
  return line;
}

}  // namespace

TEST(PathConstraint, GradientsAreConsistent) {
  const test::LinearContactToy springs = test::stopped_springs(2.0);
  const State guarded{.x = nearby.x, .lambda = nearby.lambda, .active_set = {0}};
  const ParameterValue lambda;
  EXPECT_LE(check_gradient(ValueConstraint(first, 0.3), nearby), 1e-8);
  EXPECT_LE(check_gradient(ValueConstraint(lambda, 0.3), nearby), 1e-8);
  EXPECT_LE(check_gradient(GuardConstraint(springs, 0), guarded), 1e-8);
  EXPECT_LE(check_gradient(PlaneConstraint(metric, origin, tangent, 0.1), nearby), 1e-8);
  EXPECT_LE(check_gradient(SphereConstraint(metric, Form::spherical, origin, tangent, 0.3), nearby), 1e-8);
  EXPECT_LE(check_gradient(SphereConstraint(metric, Form::cylindrical, origin, tangent, 0.3), nearby), 1e-8);
}

TEST(PathConstraint, TheUpdatedPlaneStandsAcrossTheChord) {
  const UpdatedPlaneConstraint plane(metric, origin);
  const Row row = plane.gradient(nearby);
  const Direction chord = difference(nearby, origin), d{.dx = Vector::Ones(2), .dlambda = -1.0};
  EXPECT_NEAR(apply(row, d), metric.inner(chord, d), 1e-15);
}

TEST(PathConstraint, AdvancesToWhereTheLinearisedConstraintVanishes) {
  const Direction particular{.dx = Vector{{0.05, 0.02}}, .dlambda = -0.1};
  const PlaneConstraint plane(metric, origin, tangent, 0.2);
  const auto tau = plane.advance(nearby, line_of(particular, tangent));
  ASSERT_TRUE(tau.has_value());
  EXPECT_NEAR(plane.value(moved(moved(nearby, particular, 1.0), tangent, tau->taken)), 0.0, 1e-14);
}

TEST(PathConstraint, AConstraintThatTheLineRunsAlongIsNotMet) {
  const ValueConstraint value(first, 0.3);
  const Direction along{.dx = Vector::Unit(2, 1), .dlambda = 1.0};
  EXPECT_FALSE(value.advance(nearby, line_of({.dx = Vector::Zero(2), .dlambda = 0.0}, along)).has_value());
}

TEST(SphereConstraint, TheRootIsOnTheSphereAndTheOneNearerThePreviousTangent) {
  test::Numbers numbers(72);
  for (const Form form : {Form::spherical, Form::cylindrical})
    for (int i = 0; i < 50; ++i) {
      const SphereConstraint sphere(metric, form, origin, tangent, 1.0);
      const Direction particular{.dx = 0.1 * numbers.vector(2), .dlambda = 0.1 * numbers()};
      const Direction line{.dx = numbers.vector(2), .dlambda = 4.0 * numbers()};
      const State at = moved(origin, tangent, 0.9);
      const auto tau = sphere.advance(at, line_of(particular, line));
      if (!tau) continue;
      const State there = moved(moved(at, particular, 1.0), line, tau->taken);
      EXPECT_NEAR(sphere.value(there), 0.0, 1e-10);
      // The other root is −2 (D·t)/(t·t) − τ away; it is no farther along the tangent.
      const auto inner = [&](const Direction& a, const Direction& b) {
        return form == Form::spherical ? metric.inner(a, b) : metric.inner_x(a, b);
      };
      const Direction D = difference(there, origin);
      const double other = tau->taken - 2.0 * inner(D, line) / inner(line, line);
      EXPECT_NEAR(tau->other.value(), other, 1e-8 * (1.0 + std::abs(other)));
      const State across = moved(moved(at, particular, 1.0), line, other);
      EXPECT_NEAR(sphere.value(across), 0.0, 1e-8);
      EXPECT_GE(inner(tangent, D), inner(tangent, difference(across, origin)) - 1e-12);
    }
}

TEST(SphereConstraint, ALineThatMissesTheSphereHasComplexRoots) {
  const SphereConstraint sphere(metric, Form::spherical, origin, tangent, 0.1);
  // From a point 1 away, along a direction normal to the way back.
  const Direction away{.dx = Vector{{std::sqrt(2.0), 0.0}}, .dlambda = 0.0};
  const Direction line{.dx = Vector::Unit(2, 1), .dlambda = 0.0};
  const EquilibriumLine through = line_of({.dx = Vector::Zero(2), .dlambda = 0.0}, line);
  EXPECT_FALSE(sphere.advance(moved(origin, away, 1.0), through).has_value());
}

TEST(StepConstraint, ThePredictorFulfilsEveryMethodsConstraint) {
  for (const PathMethod method :
       {PathMethod::load, PathMethod::displacement, PathMethod::riks, PathMethod::normal_plane, PathMethod::cylindrical,
        PathMethod::spherical, PathMethod::pseudo_arclength}) {
    const auto constraint = step_constraint(method, metric, origin, tangent, 0.3, &first);
    ASSERT_NE(constraint, nullptr);
    EXPECT_NEAR(constraint->value(moved(origin, tangent, 0.3)), 0.0, 1e-15);
  }
}

}  // namespace arcwall::path_constraint_test
