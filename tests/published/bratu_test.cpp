#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/convergence.hpp"
#include "tests/support/functions.hpp"
#include "tests/support/invariants.hpp"

// Bratu's problem u″ + λ eᵘ = 0: the continuum has λ = 8 a²/cosh² a, u_max = 2 ln cosh a, so its fold is at a tanh a =
// 1, λ = 3.513830719125…. Differences of second order have a fold of their own, which is solved for here without any
// continuation.
namespace arcwall::bratu_test {

namespace {

struct Fold {
  double lambda, greatest;
};

Fold continuum() {
  double a = 1.2;
  for (int i = 0; i < 50; ++i) a = 1.0 / std::tanh(a);  // contracts by 1/sinh² a = 0.44
  const double c = std::cosh(a);
  return {.lambda = 8.0 * a * a / (c * c), .greatest = 2.0 * std::log(c)};
}

// Newton's method in long double on the extended system for (u, v, λ) of Seydel (1979) and Moore & Spence (1980),
//
//   D u − λ eᵘ = 0,   D v − λ eᵘ v = 0,   Σ v² = 1
//
// from the continuum's fold, with dense matrices.
Fold discrete(Index n) {
  using Real = long double;
  using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  const Real h = Real(1) / Real(n + 1);
  RealMatrix D = RealMatrix::Zero(n, n);
  D.diagonal().setConstant(2 / (h * h));
  D.diagonal(1).setConstant(-1 / (h * h));
  D.diagonal(-1).setConstant(-1 / (h * h));
  const Real a = 1.2L;
  RealVector u(n), v(n);
  for (Index i = 0; i < n; ++i) {
    const Real x = Real(i + 1) * h;
    u[i] = 2 * std::log(std::cosh(a) / std::cosh(a * (1 - 2 * x)));
    v[i] = std::sin(Real(pi) * x);
  }
  v.normalize();
  Real lambda = 3.5L;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const RealVector e = u.array().exp(), ev = e.cwiseProduct(v);
    const RealMatrix K = D - lambda * RealMatrix(e.asDiagonal());
    RealMatrix J = RealMatrix::Zero(2 * n + 1, 2 * n + 1);
    J.topLeftCorner(n, n) = K;
    J.block(n, 0, n, n) = -lambda * RealMatrix(ev.asDiagonal());
    J.block(n, n, n, n) = K;
    J.col(2 * n) << -e, -ev, Real(0);
    J.row(2 * n).segment(n, n) = 2 * v.transpose();
    RealVector F(2 * n + 1);
    F << D * u - lambda * e, K * v, v.squaredNorm() - 1;
    const RealVector correction = J.partialPivLu().solve(F);
    u -= correction.head(n);
    v -= correction.segment(n, n);
    lambda -= correction[2 * n];
    if (correction.norm() < 1e-15L) break;
  }
  return {.lambda = double(lambda), .greatest = double(u.maxCoeff())};
}

Fold traced(Index n) {
  const test::Bratu problem(n);
  TraceOptions options;
  options.step.first = 0.2;
  options.target_values = {test::stop_at_lambda(-0.1), test::stop_at_lambda(0.5)};
  options.target_values[1].stops = false;
  options.max_points = 200;
  const test::Branch branch = test::trace(problem, options);
  const Event fold = only_event(branch, EventKind::limit_point);
  EXPECT_EQ(fold.unstable_before, 0);
  EXPECT_EQ(fold.unstable_after, 1);
  EXPECT_TRUE(events_of(branch, EventKind::branch_point).empty());
  expect_branch_invariants(problem, branch, options, {.recount_every = 10});
  return {.lambda = fold.state.lambda, .greatest = fold.state.x.maxCoeff()};
}

}  // namespace

// 9, 49 and 99 inner points: the values of the extended system agree with 3.4954932942809107815, 3.5130993908836101689
// and 3.5136479039693070908, computed with 20 digits.
TEST(Bratu, TheFoldOfTheDifferencesIsFoundExactly) {
  const std::pair<Index, double> known[] = {
      {9, 3.4954932942809107815}, {49, 3.5130993908836101689}, {99, 3.5136479039693070908}};
  for (const auto& [points, lambda] : known) {
    SCOPED_TRACE(points);
    const Fold exact = discrete(points), found = traced(points);
    EXPECT_NEAR(exact.lambda, lambda, 1e-14);
    EXPECT_NEAR(found.lambda, exact.lambda, 1e-11);
    EXPECT_NEAR(found.greatest, exact.greatest, 1e-8);
  }
}

TEST(Bratu, TheFoldConvergesToThatOfTheContinuum) {
  const Fold exact = continuum();
  EXPECT_NEAR(exact.lambda, 3.513830719125161, 1e-14);
  EXPECT_NEAR(exact.greatest, 1.186842168634389, 1e-14);
  const auto lambdas = test::on_four_meshes(10, [](int intervals) { return traced(intervals - 1).lambda; });
  test::expect_convergence(lambdas, {.exact = exact.lambda, .order = 2.0, .limit_error = 1e-9});
}

}  // namespace arcwall::bratu_test
