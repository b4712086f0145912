#include "continuation/metric.hpp"

#include <gtest/gtest.h>

#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

namespace arcwall::metric_test {

namespace {

Metric some_metric() { return {Vector{{0.5, 2.0, 0.0}}, 4.0}; }

}  // namespace

TEST(Metric, IsTheWeightedSumWithoutMultipliers) {
  const Metric metric = some_metric();
  const Direction a{.dx = Vector{{1.0, 2.0, 100.0}}, .dlambda = 8.0}, b{.dx = Vector{{3.0, -1.0, 7.0}}, .dlambda = 2.0};
  EXPECT_DOUBLE_EQ(metric.inner_x(a, b), 0.5 * 3.0 - 2.0 * 2.0);
  EXPECT_DOUBLE_EQ(metric.inner_lambda(a.dlambda, b.dlambda), 1.0);
  EXPECT_DOUBLE_EQ(metric.inner(a, b), -1.5);
  EXPECT_DOUBLE_EQ(metric.norm(a), std::sqrt(0.5 + 8.0 + 4.0));
  EXPECT_DOUBLE_EQ(apply(metric.row(a), b), metric.inner(a, b));
}

TEST(Metric, ACovectorIsBoundedByItsDualNorm) {
  const Metric metric = some_metric();
  test::Numbers numbers(70);
  for (int i = 0; i < 50; ++i) {
    Row row{.dx = numbers.vector(3), .dlambda = numbers()};
    row.dx[2] = 0.0;  // nothing depends on multipliers
    const Direction d{.dx = numbers.vector(3), .dlambda = numbers()};
    EXPECT_LE(std::abs(apply(row, d)), metric.dual_norm(row) * metric.norm(d) * (1.0 + 1e-15));
  }
  // And it is the least such bound.
  const Direction d{.dx = Vector{{1.0, -2.0, 0.0}}, .dlambda = 3.0};
  EXPECT_NEAR(metric.dual_norm(metric.row(d)), metric.norm(d), 1e-14);
}

TEST(Metric, UnitAndReversedDirections) {
  const Metric metric = some_metric();
  const Direction d{.dx = Vector{{1.0, -2.0, 5.0}}, .dlambda = 3.0};
  const Direction u = unit(metric, d);
  EXPECT_NEAR(metric.norm(u), 1.0, 1e-15);
  EXPECT_NEAR(u.dx[2] / u.dlambda, 5.0 / 3.0, 1e-15);
  EXPECT_EQ(reversed(d).dx, -d.dx);
  EXPECT_EQ(reversed(d).dlambda, -3.0);
}

TEST(Metric, LengthsOfAModelDoNotDependOnItsUnits) {
  // The same displacements and rotations in cm and in m.
  const auto in_cm = test::Channel{.elements = 10, .walls = false}.model();
  const auto in_m = test::Channel{.elements = 10, .walls = false, .cm = 0.01, .kN = 1000.0}.model();
  Vector x = test::Numbers(71).vector(in_cm.structure().size({})), y = x;
  for (Index i = 0; i < x.size(); ++i)
    if (in_cm.structure().meaning(i).dof != Dof::rotation) y[i] *= 0.01;
  const Metric a(in_cm.structure().weights({}), 0.4), b(in_m.structure().weights({}), 0.4);
  EXPECT_NEAR(a.norm({.dx = x, .dlambda = 0.1}), b.norm({.dx = y, .dlambda = 0.1}), 1e-14);
}

}  // namespace arcwall::metric_test
