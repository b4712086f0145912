#include "elements/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace arcwall::axis_test {

namespace {

constexpr double step = 1e-5;  // of differences: truncation 1e-10, round-off 1e-11

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Tangent, curvature and its rate are derivatives along s. The truncation of the last, step²/6 of a third derivative of
// the curvature, is up to 2e-7.
void expect_consistent(const Axis& axis) {
  const double L = axis.length();
  for (int i = 1; i < 40; ++i) {
    const double s = L * i / 40.0, d = step * L;
    const AxisPoint at = axis.at(s), above = axis.at(s + d), below = axis.at(s - d);
    const Vec2 tangent = (above.position - below.position) / (2.0 * d);
    EXPECT_LE((tangent - direction(at.angle)).norm(), 1e-8) << "s = " << s;
    EXPECT_NEAR((above.angle - below.angle) / (2.0 * d), at.curvature, 1e-8 * (1.0 + std::abs(at.curvature)));
    EXPECT_NEAR((above.curvature - below.curvature) / (2.0 * d), at.curvature_rate,
                1e-6 * (1.0 + std::abs(at.curvature_rate)));
  }
}

// Length of a curve by adding chords of many points: off by the square of their spacing.
template <class Curve>
double polygon_length(const Curve& curve, int parts) {
  double length = 0.0;
  for (int i = 0; i < parts; ++i) length += (curve(double(i + 1) / parts) - curve(double(i) / parts)).norm();
  return length;
}

template <class Curve>
double extrapolated_length(const Curve& curve) {
  return (4.0 * polygon_length(curve, 4000) - polygon_length(curve, 2000)) / 3.0;
}

}  // namespace

TEST(StraightAxis, IsTheChord) {
  const auto axis = straight_axis({1.0, 1.0}, {4.0, 5.0});
  EXPECT_EQ(axis->length(), 5.0);
  EXPECT_EQ(axis->at(0.0).position, Vec2(1.0, 1.0));
  EXPECT_EQ(axis->at(5.0).position, Vec2(4.0, 5.0));
  EXPECT_LE((axis->at(2.5).position - Vec2(2.5, 3.0)).norm(), 1e-15);
  EXPECT_EQ(axis->at(2.0).curvature, 0.0);
  expect_consistent(*axis);
}

TEST(ArcAxis, LiesOnTheCircleThroughTheThreePoints) {
  // R = 2 about (1, −1); less and more than half a circle, both senses.
  const Vec2 centre(1.0, -1.0);
  struct Case {
    double from, via, to;
  };
  for (const Case& c : {Case{0.2, 0.9, 1.4}, Case{1.4, 0.9, 0.2}, Case{0.0, 2.0, 4.5}, Case{3.0, 0.5, -1.9}}) {
    const auto on_circle = [&](double angle) { return Vec2(centre + 2.0 * direction(angle)); };
    const auto axis = arc_axis(on_circle(c.from), on_circle(c.via), on_circle(c.to));
    EXPECT_NEAR(axis->length(), 2.0 * std::abs(c.to - c.from), 1e-13);
    EXPECT_LE((axis->at(axis->length()).position - on_circle(c.to)).norm(), 1e-13);
    EXPECT_LE((axis->at(2.0 * std::abs(c.via - c.from)).position - on_circle(c.via)).norm(), 1e-13);
    for (int i = 0; i <= 10; ++i) {
      const AxisPoint at = axis->at(axis->length() * i / 10.0);
      EXPECT_NEAR((at.position - centre).norm(), 2.0, 1e-13);
      EXPECT_NEAR(at.curvature, c.to > c.from ? 0.5 : -0.5, 1e-14);
    }
    expect_consistent(*axis);
  }
}

TEST(SineAxis, FollowsTheSineOverItsChord) {
  const Vec2 from(0.5, 0.0), to(2.5, 1.0);
  const Vec2 normal = perp((to - from).normalized());
  const auto axis = sine_axis(from, to, 0.2, 3);
  const auto curve = [&](double t) { return Vec2(from + t * (to - from) + 0.2 * std::sin(3.0 * pi * t) * normal); };
  EXPECT_NEAR(axis->length(), extrapolated_length(curve), 1e-11);
  expect_consistent(*axis);
  for (int i = 0; i <= 20; ++i) {
    const Vec2 at = axis->at(axis->length() * i / 20.0).position;
    const double t = (at - from).dot(to - from) / (to - from).squaredNorm();
    EXPECT_LE((at - curve(t)).norm(), 1e-14);
  }
}

TEST(SplineAxis, GoesThroughItsPointsAndIsMeasuredByArcLength) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.4}, {1.8, -0.1}, {3.0, 0.2}, {3.5, 1.0}};
  const auto axis = spline_axis(points);
  expect_consistent(*axis);
  EXPECT_EQ(axis->at(0.0).position, points.front());
  EXPECT_LE((axis->at(axis->length()).position - points.back()).norm(), 1e-13);
  for (const Vec2& point : points) {
    double nearest = infinity;
    for (int i = 0; i <= 20000; ++i)
      nearest = std::min(nearest, (axis->at(axis->length() * i / 20000.0).position - point).norm());
    EXPECT_LE(nearest, axis->length() / 20000.0);
  }
}

TEST(SplineAxis, OfTwoPointsIsTheirChord) {
  const auto axis = spline_axis({{0.0, 0.0}, {3.0, 4.0}});
  EXPECT_NEAR(axis->length(), 5.0, 1e-14);
  EXPECT_NEAR(axis->at(1.0).angle, std::atan2(4.0, 3.0), 1e-15);
}

TEST(ParametricAxes, EqualStepsOfArcLengthAreEquallyFarApart) {
  for (const auto& axis :
       {sine_axis({0.0, 0.0}, {1.0, 0.0}, 0.3, 2), spline_axis({{0, 0}, {1, 1}, {2, 0}, {2.5, -1}})}) {
    constexpr int parts = 2000;
    const double h = axis->length() / parts;
    for (int i = 0; i < parts; ++i) {
      const double chord = (axis->at(h * (i + 1)).position - axis->at(h * i).position).norm();
      const double bend = axis->at(h * (i + 0.5)).curvature * h;
      EXPECT_NEAR(chord, h * (1.0 - bend * bend / 24.0), 1e-6 * h * (1e-3 + std::abs(bend)));
    }
  }
}

TEST(ImperfectAxis, DeviatesNormalToTheAxisBySines) {
  const auto axis = straight_axis({0.0, 0.0}, {0.0, 2.0});  // upwards: its left is −x
  const ImperfectAxis shape(*axis, {{.amplitude = 0.01, .waves = 1}, {.amplitude = 0.003, .waves = 3}});
  for (const double s : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const double y = 0.01 * std::sin(pi * s / 2.0) + 0.003 * std::sin(3.0 * pi * s / 2.0);
    EXPECT_LE((shape.at(s).position - Vec2(-y, s)).norm(), 1e-16);
  }
}

TEST(ImperfectAxis, AnglesAndLengthsAreThoseOfTheDeviatedCurve) {
  const auto arc = arc_axis({-1.0, 0.0}, {0.0, 0.6}, {1.0, 0.0});
  const ImperfectAxis shape(*arc, {{.amplitude = 0.05, .waves = 2}});
  const double L = arc->length();
  for (int i = 1; i < 20; ++i) {
    const double s = L * i / 20.0, d = step * L;
    const Vec2 along = shape.at(s + d).position - shape.at(s - d).position;
    EXPECT_LE((along.normalized() - direction(shape.at(s).angle)).norm(), 1e-8);
  }
  const auto curve = [&](double t) { return shape.at((0.2 + 0.5 * t) * L).position; };
  EXPECT_NEAR(shape.length(0.2 * L, 0.7 * L), extrapolated_length(curve), 1e-11);
}

TEST(ImperfectAxis, WithoutDeviationsIsTheAxis) {
  const auto arc = arc_axis({-1.0, 0.0}, {0.0, 0.6}, {1.0, 0.0});
  const ImperfectAxis shape(*arc, {});
  EXPECT_EQ(shape.at(0.5).position, arc->at(0.5).position);
  EXPECT_EQ(shape.at(0.5).angle, arc->at(0.5).angle);
  EXPECT_EQ(shape.length(0.25, 0.75), 0.5);
}

}  // namespace arcwall::axis_test
