#include "core/derivative_check.hpp"

#include <gtest/gtest.h>

#include "tests/support/toys.hpp"

namespace arcwall::derivative_check_test {

namespace {

using test::SmoothToy;

// Energy ¼ |x|⁴ + λ x₀ x₁: right in every derivative.
SmoothToy right() {
  SmoothToy toy;
  toy.unknowns = 2;
  toy.potential = [](const Vector& x, double lambda) {
    return 0.25 * x.squaredNorm() * x.squaredNorm() + lambda * x[0] * x[1];
  };
  toy.F = [](const Vector& x, double lambda) -> Vector { return x.squaredNorm() * x + lambda * x.reverse(); };
  toy.K = [](const Vector& x, double lambda) -> Matrix {
    Matrix K = x.squaredNorm() * Matrix::Identity(2, 2) + 2.0 * x * x.transpose();
    K(0, 1) += lambda;
    K(1, 0) += lambda;
    return K;
  };
  toy.F_lambda = [](const Vector& x, double) -> Vector { return x.reverse(); };
  return toy;
}

const State somewhere{.x = Vector{{0.7, -0.4}}, .lambda = 0.3};

// A system whose guard is x₀² λ, and that says so or not.
struct Guarded final : SmoothToy {
  double factor = 1.0;
  explicit Guarded(double f) : SmoothToy(right()), factor(f) {}
  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = unknowns, .bounds = 1}; }
  Vector guards(const State& s) const override { return test::scalar(s.x[0] * s.x[0] * s.lambda); }
  Row guard_gradient(const State& s, Index) const override {
    return {.dx = Vector{{2.0 * s.x[0] * s.lambda, 0.0}}, .dlambda = factor * s.x[0] * s.x[0]};
  }
};

// Residual and linearization disagree.
struct Inconsistent final : SmoothToy {
  Inconsistent() : SmoothToy(right()) {}
  void linearize(const State& s, Linearization& out) const override {
    SmoothToy::linearize(s, out);
    out.F[0] *= 1.001;
  }
};

struct Square final : Observable {
  double factor = 2.0;
  double value(const State& s) const override { return s.x.squaredNorm() * s.lambda; }
  Row gradient(const State& s) const override { return {.dx = factor * s.lambda * s.x, .dlambda = s.x.squaredNorm()}; }
};

}  // namespace

// Central differences of fourth order and step 1e-4: truncation 1e-16 of fifth derivatives, round-off ε/1e-4 = 2e-12.
TEST(DerivativeCheck, ARightSystemPasses) {
  EXPECT_LE(check_derivatives(right(), somewhere).worst(), 1e-10);
  EXPECT_LE(check_derivatives(Guarded(1.0), somewhere).worst(), 1e-10);
}

TEST(DerivativeCheck, FindsAWrongK) {
  SmoothToy toy = right();
  toy.K = [K = toy.K](const Vector& x, double lambda) -> Matrix {
    Matrix wrong = K(x, lambda);
    wrong(1, 0) *= 1.001;
    return wrong;
  };
  const DerivativeReport report = check_derivatives(toy, somewhere);
  EXPECT_GE(report.K, 1e-5);
  EXPECT_LE(report.F_lambda, 1e-8);
  EXPECT_EQ(report.worst(), report.K);
}

TEST(DerivativeCheck, FindsAWrongDerivativeInLambda) {
  SmoothToy toy = right();
  toy.F_lambda = [](const Vector& x, double) -> Vector { return 1.001 * x.reverse(); };
  const DerivativeReport report = check_derivatives(toy, somewhere);
  EXPECT_NEAR(report.F_lambda, 1e-3, 1e-5);
  EXPECT_EQ(report.worst(), report.F_lambda);
}

TEST(DerivativeCheck, FindsAnEnergyThatIsNotThePotential) {
  SmoothToy toy = right();
  toy.potential = [](const Vector& x, double) { return 0.25 * x.squaredNorm() * x.squaredNorm(); };
  EXPECT_GE(check_derivatives(toy, somewhere).energy, 1e-2);
}

TEST(DerivativeCheck, FindsAResidualThatIsNotTheLinearizations) {
  EXPECT_GE(check_derivatives(Inconsistent(), somewhere).consistency, 1e-4);
}

TEST(DerivativeCheck, FindsAWrongGuardGradientInXAndInLambda) {
  EXPECT_GE(check_derivatives(Guarded(1.001), somewhere).guard_gradient, 1e-4);
}

TEST(GradientCheck, TellsRightFromWrong) {
  Square square;
  EXPECT_LE(check_gradient(square, somewhere), 1e-10);
  square.factor = 2.002;
  EXPECT_GE(check_gradient(square, somewhere), 5e-4);
  EXPECT_LE(check_gradient(ScaledObservable(std::make_shared<Square>(), -3.0), somewhere), 1e-8);
  EXPECT_LE(check_gradient(ParameterValue(), somewhere), 1e-8);
}

}  // namespace arcwall::derivative_check_test
