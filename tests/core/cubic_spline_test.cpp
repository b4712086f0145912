#include "core/cubic_spline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/types.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::cubic_spline_test {

namespace {

double polynomial(double t, int derivative) {  // 2 − t + 3 t² − 0.5 t³
  switch (derivative) {
    case 0:
      return 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
    case 1:
      return -1.0 + 6.0 * t - 1.5 * t * t;
    case 2:
      return 6.0 - 3.0 * t;
    default:
      return -3.0;
  }
}

CubicSpline through(const std::vector<double>& t, double (*f)(double)) {
  std::vector<double> v;
  for (const double at : t) v.push_back(f(at));
  return {t, v};
}

std::vector<double> equally_spaced(int parts, double length) {
  std::vector<double> t;
  for (int i = 0; i <= parts; ++i) t.push_back(length * i / parts);
  return t;
}

}  // namespace

TEST(CubicSpline, ReproducesCubicsOnAnyKnotsAndBeyond) {
  const CubicSpline spline = through({-1.0, -0.7, 0.1, 0.2, 1.5, 2.0}, [](double t) { return polynomial(t, 0); });
  EXPECT_EQ(spline.first(), -1.0);
  EXPECT_EQ(spline.last(), 2.0);
  for (double t = -1.5; t < 2.5; t += 0.13) {
    const auto v = spline.at(t);
    for (int d = 0; d < 4; ++d) EXPECT_NEAR(v[static_cast<std::size_t>(d)], polynomial(t, d), 1e-12);
  }
}

TEST(CubicSpline, IsTwiceContinuousAndInterpolates) {
  test::Numbers numbers(12);
  const std::vector<double> t{0.0, 0.5, 0.7, 1.6, 2.0, 3.1};
  std::vector<double> v;
  for (std::size_t i = 0; i < t.size(); ++i) v.push_back(numbers());
  const CubicSpline spline(t, v);
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_NEAR(spline.at(t[i])[0], v[i], 1e-15);
    if (i == 0 || i + 1 == t.size()) continue;
    // Third derivatives are below 100 here: over 2e-9 the second derivative moves by less than 1e-6.
    const auto before = spline.at(t[i] - 1e-9), after = spline.at(t[i] + 1e-9);
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(before[d], after[d], 1e-6);
  }
  // No knot at the second and the last but one.
  EXPECT_NEAR(spline.at(0.25)[3], spline.at(0.6)[3], 1e-11);
  EXPECT_NEAR(spline.at(1.8)[3], spline.at(2.5)[3], 1e-11);
}

TEST(CubicSpline, DerivativesAreThoseOfTheValue) {
  const CubicSpline spline = through(equally_spaced(7, 3.0), [](double t) { return std::exp(-t); });
  constexpr double step = 1e-5;  // truncation 1e-10, round-off 1e-11
  for (double t = 0.05; t < 3.0; t += 0.17) {
    const auto below = spline.at(t - step), above = spline.at(t + step), at = spline.at(t);
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR((above[d] - below[d]) / (2.0 * step), at[d + 1], 1e-8);
  }
}

// Beside a knot the third derivative goes over from one cubic to the next; farther off nothing changes.
TEST(CubicSpline, IsRoundedAtItsKnotsAloneAndThenThriceContinuous) {
  const std::vector<double> t{0.0, 0.5, 0.7, 1.6, 2.0, 3.1}, v{0.3, -0.2, 0.4, 0.1, 0.9, 0.2};
  constexpr double rounding = 0.1;
  const CubicSpline sharp(t, v), spline(t, v, rounding);
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const double w = rounding * std::min(t[i] - t[i - 1], t[i + 1] - t[i]);
    const double jump = sharp.at(t[i] + 1e-9)[3] - sharp.at(t[i] - 1e-9)[3];
    for (const double xi : {-1.0, 1.0})
      for (std::size_t d = 0; d < 4; ++d) {
        const double inside = spline.at(t[i] + xi * w * (1.0 - 1e-9))[d];
        EXPECT_NEAR(inside, spline.at(t[i] + xi * w * (1.0 + 1e-9))[d], 1e-6);
        EXPECT_EQ(spline.at(t[i] + 1.001 * xi * w)[d], sharp.at(t[i] + 1.001 * xi * w)[d]);
      }
    for (double xi = -0.95; xi < 1.0; xi += 0.1) {
      const double at = t[i] + xi * w, step = 1e-4 * w;
      EXPECT_LE(std::abs(spline.at(at)[0] - sharp.at(at)[0]), 0.006 * std::abs(jump) * w * w * w + 1e-14);
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR((spline.at(at + step)[d] - spline.at(at - step)[d]) / (2.0 * step), spline.at(at)[d + 1],
                    1e-6 * (1.0 + std::abs(jump)));
    }
  }
}

// A sine over a stretch whose ends are no zeros of its fourth derivative: there the error is of order 5.
TEST(CubicSpline, ConvergesWithOrderFour) {
  std::vector<double> sizes, errors;
  for (const int parts : {8, 16, 32, 64}) {
    const CubicSpline spline = through(equally_spaced(parts, 4.0), [](double t) { return std::sin(t + 0.7); });
    double error = 0.0;
    for (double t = 0.0; t < 4.0; t += 0.003) error = std::max(error, std::abs(spline.at(t)[0] - std::sin(t + 0.7)));
    sizes.push_back(1.0 / parts);
    errors.push_back(error);
  }
  EXPECT_NEAR(test::observed_order(sizes, errors), 4.0, 0.3);
  EXPECT_NEAR(test::observed_order({sizes[2], sizes[3]}, {errors[2], errors[3]}), 4.0, 0.2);
}

TEST(CubicSpline, IsAParabolaThroughThreePointsAndALineThroughTwo) {
  const CubicSpline parabola({0.0, 1.0, 3.0}, {1.0, 2.0, 10.0});  // 1 + t²
  EXPECT_NEAR(parabola.at(2.0)[0], 5.0, 1e-14);
  EXPECT_NEAR(parabola.at(2.0)[2], 2.0, 1e-14);
  EXPECT_NEAR(parabola.at(2.0)[3], 0.0, 1e-14);
  const CubicSpline line({1.0, 3.0}, {2.0, 8.0});
  EXPECT_NEAR(line.at(0.0)[0], -1.0, 1e-14);
  EXPECT_NEAR(line.at(2.5)[1], 3.0, 1e-14);
  EXPECT_EQ(line.at(2.5)[2], 0.0);
}

}  // namespace arcwall::cubic_spline_test
