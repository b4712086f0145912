#include "core/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arcwall::lanes_test {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Of the last place of `exact`, by which `value` differs from it.
double units(double value, long double exact) {
  const double magnitude = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(magnitude, infinity) - magnitude;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / unit;
}

}  // namespace

// Against the C library's function of long double.
TEST(Lanes, ArcTangentIsExactToTwoUnitsInTheLastPlace) {
  for (const double length : {1e-150, 1.0, 3e80})
    for (int i = -20000; i <= 20000; ++i) {
      const double angle = 1.00003 * pi * i / 20000.0, x = length * std::cos(angle), y = length * std::sin(angle);
      ASSERT_LE(units(arc_tangent(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))), 2.0)
          << "y = " << y << ", x = " << x;
    }
  for (double y = 1.0; y > 1e-300; y *= 0.37)
    for (const double sign : {-1.0, 1.0}) {
      ASSERT_LE(units(arc_tangent(sign * y, 1.0), std::atan2(static_cast<long double>(sign * y), 1.0L)), 2.0) << y;
      ASSERT_LE(units(arc_tangent(1.0, sign * y), std::atan2(1.0L, static_cast<long double>(sign * y))), 2.0) << y;
    }
}

TEST(Lanes, ArcTangentKnowsTheAxes) {
  EXPECT_EQ(arc_tangent(0.0, 2.0), 0.0);
  EXPECT_EQ(arc_tangent(2.0, 0.0), 0.5 * pi);
  EXPECT_EQ(arc_tangent(-2.0, 0.0), -0.5 * pi);
  EXPECT_EQ(arc_tangent(0.0, -2.0), pi);
  EXPECT_TRUE(std::isnan(arc_tangent(nan, 1.0)));
  EXPECT_TRUE(std::isnan(arc_tangent(1.0, nan)));
}

TEST(Lanes, ArcTangentsOfFourAreThoseOfEach) {
  for (int i = 0; i < 4000; ++i) {
    const double angle = 0.0041 * i;
    double y[4], x[4];
    for (int lane = 0; lane < 4; ++lane) {
      y[lane] = std::sin(angle + lane);
      x[lane] = (1.0 + lane) * std::cos(angle + lane);
    }
    const Lanes four = arc_tangent(Lanes(y[0], y[1], y[2], y[3]), Lanes(x[0], x[1], x[2], x[3]));
    for (int lane = 0; lane < 4; ++lane) ASSERT_EQ(four[lane], arc_tangent(y[lane], x[lane]));
  }
}

// Against the C library's functions of long double.
TEST(Lanes, CosineAndSineAreExactToTwoUnitsInTheLastPlace) {
  for (int i = -20000; i <= 20000; ++i) {
    const double angle = 0.25 * pi * i / 20000.0;
    const auto turn = cosine_and_sine(angle);
    ASSERT_LE(units(turn.cosine, std::cos(static_cast<long double>(angle))), 2.0) << angle;
    ASSERT_LE(units(turn.sine, std::sin(static_cast<long double>(angle))), 2.0) << angle;
  }
  for (int i = -300000; i <= 300000; ++i) {
    const double angle = 3.3 * i;
    const auto turn = cosine_and_sine(angle);
    ASSERT_NEAR(turn.cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), 0x1p-52) << angle;
    ASSERT_NEAR(turn.sine, static_cast<double>(std::sin(static_cast<long double>(angle))), 0x1p-52) << angle;
  }
  EXPECT_EQ(cosine_and_sine(0.0).sine, 0.0);
  EXPECT_EQ(cosine_and_sine(0.0).cosine, 1.0);
  EXPECT_TRUE(std::isnan(cosine_and_sine(nan).sine));
  EXPECT_TRUE(std::isnan(cosine_and_sine(nan).cosine));
}

TEST(Lanes, CosinesAndSinesOfFourAreThoseOfEach) {
  for (int i = 0; i < 4000; ++i) {
    const double angle[4]{0.01 * i, -0.37 * i, 13.1 * i, 1e-9 * i};
    const auto four = cosine_and_sine(Lanes(angle[0], angle[1], angle[2], angle[3]));
    for (int lane = 0; lane < 4; ++lane) {
      ASSERT_EQ(four.cosine[lane], cosine_and_sine(angle[lane]).cosine);
      ASSERT_EQ(four.sine[lane], cosine_and_sine(angle[lane]).sine);
    }
  }
}

}  // namespace arcwall::lanes_test
