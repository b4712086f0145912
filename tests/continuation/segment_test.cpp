#include "continuation/segment.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace arcwall::segment_test {

namespace {

const Metric metric(Vector::Ones(1), 1.0);

PathPoint point(double x, double lambda, double dx, double dlambda) {
  PathPoint p;
  p.state = {.x = Vector::Constant(1, x), .lambda = lambda};
  p.tangent = unit(metric, {.dx = Vector::Constant(1, dx), .dlambda = dlambda});
  return p;
}

}  // namespace

TEST(Segment, InterpolatesPointsAndTangentsOfItsEnds) {
  const PathPoint from = point(0.0, 0.0, 1.0, 0.5), to = point(3.0, 4.0, 0.2, 1.0);
  const Segment segment(metric, from, to);
  EXPECT_DOUBLE_EQ(segment.length(), 5.0);
  EXPECT_EQ(segment.at(0.0).x, from.state.x);
  EXPECT_NEAR(segment.at(1.0).x[0], 3.0, 1e-15);
  EXPECT_NEAR(segment.at(1.0).lambda, 4.0, 1e-15);
  constexpr double step = 1e-6;
  for (const auto& [t, end] : {std::pair(0.0, &from), std::pair(1.0, &to)}) {
    const Direction rate = difference(segment.at(t + step), segment.at(t - step));
    EXPECT_NEAR(rate.dx[0] / (2.0 * step * 5.0), end->tangent.dx[0], 1e-9);
    EXPECT_NEAR(rate.dlambda / (2.0 * step * 5.0), end->tangent.dlambda, 1e-9);
  }
}

TEST(Segment, FindsTheFirstZeroOfAQuantityAndIgnoresOneAtItsStart) {
  const PathPoint from = point(0.0, 0.0, 1.0, 0.0), to = point(2.0, 0.0, 1.0, 0.0);
  const Segment segment(metric, from, to);
  EXPECT_NEAR(segment.first_zero(1.0, -1.0, -1.0, -1.0, 1e-12).value(), 0.5, 1e-15);
  EXPECT_FALSE(segment.first_zero(1.0, 0.0, 2.0, 0.0, 1e-12).has_value());
  EXPECT_FALSE(segment.first_zero(1e-13, 1.0, 2.0, 1.0, 1e-12).has_value());
  // Within the noise of zero, but going the other way and back: 2 t (t − ½) has slopes −½ and 3/2 over the length 2.
  EXPECT_NEAR(segment.first_zero(1e-13, -0.5, 1.0, 1.5, 1e-12).value(), 0.5, 1e-12);
}

}  // namespace arcwall::segment_test
