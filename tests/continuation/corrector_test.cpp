#include "continuation/step/corrector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/toys.hpp"

namespace arcwall::corrector_test {

namespace {

const Metric metric(Vector::Ones(1), 1.0);
const Direction up{.dx = Vector::Zero(1), .dlambda = 1.0};
const ParameterValue lambda;

State at(double x, double lambda_) { return {.x = test::scalar(x), .lambda = lambda_}; }

// One unknown from F, its slope and ∂F/∂λ.
test::SmoothToy toy(double (*F)(double), double (*slope)(double), double F_lambda) {
  test::SmoothToy system;
  system.F = [=](const Vector& x, double l) { return test::scalar(F(x[0]) + F_lambda * l); };
  system.K = [=](const Vector& x, double) { return test::scalar_matrix(slope(x[0])); };
  system.F_lambda = [=](const Vector&, double) { return test::scalar(F_lambda); };
  return system;
}

CorrectorStatus status_at_fixed_load(const System& system, const State& guess, const CorrectorOptions& options = {}) {
  Corrector corrector(system, options, 1.0);
  return corrector.correct(guess, ValueConstraint(lambda, guess.lambda), metric, up, 1.0).status;
}

}  // namespace

TEST(Corrector, ArrivesAtThePathWithTangentSignsAndResidual) {
  const test::SmoothToy system = test::fold();  // x = −√−λ is unstable
  Corrector corrector(system, {}, 1.0);
  const auto result = corrector.correct(at(-0.8, -0.5), ValueConstraint(lambda, -0.5), metric, up, 0.2);
  ASSERT_TRUE(result.converged());
  const double x = -std::sqrt(0.5);
  EXPECT_NEAR(result.state.x[0], x, 1e-12);
  EXPECT_EQ(result.state.lambda, -0.5);
  EXPECT_EQ(result.negative, 1);
  EXPECT_LE(result.residual, 1e-12);
  EXPECT_LE(result.iterations, 5);
  EXPECT_NEAR(metric.norm(result.tangent), 1.0, 1e-15);
  EXPECT_NEAR(2.0 * x * result.tangent.dx[0] + result.tangent.dlambda, 0.0, 1e-12);
}

TEST(Corrector, FindsPairsAlongOrLater) {
  const test::SmoothToy system = test::fold();
  const ValueConstraint hold(lambda, -0.5);
  Corrector along(system, {}, 1.0), later(system, {}, 1.0);
  const auto whole = along.correct(at(-0.8, -0.5), hold, metric, up, 0.2);
  const auto alone = later.correct(at(-0.8, -0.5), hold, metric, up, 0.2, Wanted::tangent);
  ASSERT_TRUE(whole.converged() && alone.converged());
  EXPECT_EQ(alone.state, whole.state);
  EXPECT_EQ(alone.tangent.dx, whole.tangent.dx);
  EXPECT_EQ(alone.residual, whole.residual);
  EXPECT_EQ(alone.nearest.values.size(), 0);
  EXPECT_FALSE(alone.negative);

  const auto pairs = later.find_pairs(alone.state, metric);
  EXPECT_EQ(pairs.negative, Index{1});
  ASSERT_EQ(pairs.nearest.values.size(), 1);
  EXPECT_NEAR(pairs.nearest.values[0], 2.0 * whole.state.x[0], 1e-12);
  EXPECT_EQ(*pairs.nearest.vectors, *whole.nearest.vectors);
}

TEST(Corrector, ConvergesAtALimitPointUnderAPlane) {
  const test::SmoothToy system = test::fold();
  Corrector corrector(system, {}, 1.0);
  const Direction along{.dx = test::scalar(-1.0), .dlambda = 0.0};
  const State origin = at(0.1, -0.01);
  const PlaneConstraint plane(metric, origin, along, 0.1);  // x = 0
  const auto result = corrector.correct(at(0.0, 0.001), plane, metric, along, 0.1);
  ASSERT_TRUE(result.converged());
  EXPECT_NEAR(result.state.x[0], 0.0, 1e-12);
  EXPECT_NEAR(result.state.lambda, 0.0, 1e-12);
  EXPECT_NEAR(std::abs(result.tangent.dx[0]), 1.0, 1e-12);
}

TEST(Corrector, SaysThatItTookTooLong) {
  const CorrectorOptions hasty{.max_iterations = 2};
  EXPECT_EQ(status_at_fixed_load(test::fold(), at(3.0, -0.5), hasty), CorrectorStatus::too_many_iterations);
}

TEST(Corrector, SaysThatItDiverges) {
  // Newton on the arc tangent from beyond 1.39 overshoots by more and more.
  const auto system = toy([](double x) { return std::atan(x); }, [](double x) { return 1.0 / (1.0 + x * x); }, -1.0);
  EXPECT_EQ(status_at_fixed_load(system, at(3.0, 0.0)), CorrectorStatus::diverged);
  EXPECT_EQ(status_at_fixed_load(system, at(0.5, 0.0)), CorrectorStatus::converged);
}

TEST(Corrector, SaysThatRootsAreComplex) {
  // The line of a spring's equilibria passes the origin's sphere: x = λ + 10 is 7 away.
  const auto system = toy([](double x) { return x - 10.0; }, [](double) { return 1.0; }, -1.0);
  Corrector corrector(system, {}, 1.0);
  const State origin = at(0.0, 0.0);
  const SphereConstraint sphere(metric, SphereConstraint::Form::spherical, origin, up, 0.5);
  EXPECT_EQ(corrector.correct(at(0.0, 0.5), sphere, metric, up, 0.5).status, CorrectorStatus::complex_roots);
}

TEST(Corrector, SaysThatTheEquationsAreSingular) {
  const auto system = toy([](double) { return 1.0; }, [](double) { return 0.0; }, 0.0);
  EXPECT_EQ(status_at_fixed_load(system, at(0.0, 0.0)), CorrectorStatus::singular);
}

TEST(Corrector, SaysThatNumbersAreNotFinite) {
  const auto system = toy([](double x) { return std::sqrt(x); }, [](double x) { return 0.5 / std::sqrt(x); }, -1.0);
  EXPECT_EQ(status_at_fixed_load(system, at(-1.0, 0.5)), CorrectorStatus::not_finite);
  const auto bad_slope =
      toy([](double x) { return x; }, [](double) { return std::numeric_limits<double>::quiet_NaN(); }, -1.0);
  EXPECT_EQ(status_at_fixed_load(bad_slope, at(1.0, 0.5)), CorrectorStatus::not_finite);
}

TEST(Corrector, InspectsWithoutMoving) {
  const test::SmoothToy system = test::spring(4.0);
  Corrector corrector(system, {}, 1.0);
  const auto result = corrector.inspect(at(0.25, 1.0), metric, up);
  ASSERT_TRUE(result.converged());
  EXPECT_EQ(result.state.x[0], 0.25);
  EXPECT_EQ(result.negative, 0);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_NEAR(std::abs(result.tangent.dx[0] / result.tangent.dlambda), 0.25, 1e-15);
}

TEST(Corrector, CountsNegativeEigenvaluesWithAllContactsHeld) {
  test::LinearContactToy toy;
  toy.A = Matrix{{-1.0, 0.0}, {0.0, -1.0}};
  toy.f = Vector::Ones(2);
  toy.G = Matrix{{1.0, 0.0}};
  toy.gap0 = Vector::Zero(1);
  Corrector corrector(toy, {}, 1.0);
  const State held{.x = Vector{{0.0, 1.0, 1.0}}, .lambda = -1.0, .active_set = {1}};
  const auto result = corrector.inspect(held, Metric(toy.weights({1}), 1.0), {.dx = Vector::Zero(3), .dlambda = 1.0});
  ASSERT_TRUE(result.converged());
  EXPECT_EQ(result.negative, 1);
}

// x³ − 3x + 3 from 2: the second iterate lies beside the minimum at 1, from where the third correction is long. The
// only root is that of Cardano's formula.
TEST(Corrector, PatienceOutlastsCorrectionsThatGrow) {
  const auto system =
      toy([](double x) { return x * x * x - 3.0 * x + 3.0; }, [](double x) { return 3.0 * x * x - 3.0; }, 0.0);
  const double q = 1.5, root = std::sqrt(q * q - 1.0);
  const double exact = -std::cbrt(q + root) - std::cbrt(q - root);
  EXPECT_EQ(status_at_fixed_load(system, at(2.0, 0.0)), CorrectorStatus::diverged);

  Corrector corrector(system, {}, 1.0);
  const auto result = corrector.correct_patiently(at(2.0, 0.0), ValueConstraint(lambda, 0.0), metric, up, 1.0);
  ASSERT_TRUE(result.converged());
  EXPECT_NEAR(result.state.x[0], exact, 1e-12);
}

TEST(Corrector, PatienceHasAnEnd) {
  const auto system = toy([](double x) { return x * x + 1.0; }, [](double x) { return 2.0 * x; }, 0.0);
  Corrector corrector(system, {}, 1.0);
  const auto result = corrector.correct_patiently(at(0.7, 0.0), ValueConstraint(lambda, 0.0), metric, up, 1.0);
  EXPECT_EQ(result.status, CorrectorStatus::too_many_iterations);
}

}  // namespace arcwall::corrector_test
