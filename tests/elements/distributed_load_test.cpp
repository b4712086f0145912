#include "elements/distributed_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/axis.hpp"
#include "tests/elements/element_checks.hpp"

namespace arcwall::distributed_load_test {

namespace {

// An arc that turns by 0.8.
StretchReference curved() {
  constexpr double half = 0.4;
  const Vec2 chord(1.0, 0.7);
  const auto arc = arc_axis({0.0, 0.0}, 0.5 * chord + 0.5 * std::tan(0.5 * half) * perp(chord), chord);
  return stretch_reference(ImperfectAxis(*arc, {}), 0.0, arc->length());
}

StretchReference straight(const Vec2& chord) {
  const auto axis = straight_axis({0.0, 0.0}, chord);
  return stretch_reference(ImperfectAxis(*axis, {}), 0.0, chord.norm());
}

const LineLoad load{.first = {0.8, -2.0}};

}  // namespace

TEST(BeamDistributedLoad, DerivativesAreConsistent) {
  test::Numbers numbers(26);
  const BeamDistributedLoad element(curved(), load);
  for (int i = 0; i < 5; ++i) test::expect_derivatives(element, numbers.vector(6));
}

TEST(BeamDistributedLoad, ForcesAddUpToTheLoadAndTheirMomentIsThatAtTheMeanPosition) {
  test::Numbers numbers(27);
  const StretchReference reference = curved();
  const Vector u = numbers.vector(6);
  const Vector f = test::evaluated(BeamDistributedLoad(reference, load), u).f;
  const Vec2 resultant = reference.length * load.first;
  EXPECT_LE((f.segment<2>(0) + f.segment<2>(3) + resultant).norm(), 1e-14);
  // About node 1, at the origin; the mean of Hermite's cubic with end angles φ against the undeformed chord's direction
  // of rest is half the chord plus its normal times (φ1 − φ2)/12.
  const Vec2 chord = reference.chord + u.segment<2>(3) - u.segment<2>(0);
  const double bend = (reference.angles.front() + u[2] - reference.angles.back() - u[5]) / 12.0;
  const Vec2 mean = 0.5 * chord + bend * perp(chord);
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  EXPECT_NEAR(f[2] + f[5] + cross(chord, f.segment<2>(3)), -cross(mean, resultant), 1e-13);
}

TEST(BeamDistributedLoad, OnAStraightBeamEquivalentForcesAreThoseOfTheTextbook) {
  constexpr double h = 0.8, q = 3.0;
  const BeamDistributedLoad element(straight({h, 0.0}), {.first = {0.0, q}});
  const Vector f = -test::evaluated(element, Vector::Zero(6)).f;
  EXPECT_NEAR(f[1], q * h / 2.0, 1e-14);
  EXPECT_NEAR(f[4], q * h / 2.0, 1e-14);
  EXPECT_NEAR(f[2], q * h * h / 12.0, 1e-14);
  EXPECT_NEAR(f[5], -q * h * h / 12.0, 1e-14);
}

// A load that grows from zero to q: 3 q h/20 and 7 q h/20, q h²/30 and −q h²/20.
TEST(BeamDistributedLoad, OnAStraightBeamOfATriangleIsThatOfTheTextbook) {
  constexpr double h = 0.8, q = 3.0;
  const BeamDistributedLoad element(straight({h, 0.0}), {.slope = {0.0, q / h}}, 0.0, h);
  const Vector f = -test::evaluated(element, Vector::Zero(6)).f;
  EXPECT_NEAR(f[1], 3.0 * q * h / 20.0, 1e-14);
  EXPECT_NEAR(f[4], 7.0 * q * h / 20.0, 1e-14);
  EXPECT_NEAR(f[2], q * h * h / 30.0, 1e-14);
  EXPECT_NEAR(f[5], -q * h * h / 20.0, 1e-14);
}

TEST(BeamDistributedLoad, DoesNoWorkAtRest) {
  EXPECT_EQ(test::evaluated(BeamDistributedLoad(curved(), load), Vector::Zero(6)).energy, 0.0);
}

TEST(StretchLoad, DerivativesAreConsistent) {
  constexpr double step = 1e-6;
  test::Numbers numbers(29);
  const auto arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  const ImperfectAxis shape(*arc, {{.amplitude = 0.05, .waves = 2}});
  const auto at = [&](const Vector& q, double from, double to) {
    return StretchLoad(stretch_reference(shape, from, to), load).respond(q.head<2>(), q[2], q.segment<2>(3), q[5]);
  };
  const Vector q = numbers.vector(6);
  const auto here = at(q, 0.5, 0.9);
  EXPECT_LE((here.stiffness - here.stiffness.transpose()).norm(), 1e-14);
  for (Index i = 0; i < 6; ++i) {
    Vector above = q, below = q;
    above[i] += step;
    below[i] -= step;
    const auto a = at(above, 0.5, 0.9), b = at(below, 0.5, 0.9);
    EXPECT_NEAR((a.energy - b.energy) / (2.0 * step), here.force[i], 1e-9);
    EXPECT_LE(((a.force - b.force) / (2.0 * step) - here.stiffness.col(i)).norm(), 1e-9);
  }
  const auto rate = [&](double by1, double by2) {
    return ((at(q, 0.5 + by1, 0.9 + by2).force - at(q, 0.5 - by1, 0.9 - by2).force) / (2.0 * step)).eval();
  };
  EXPECT_LE((here.force_rate[0] - rate(step, 0.0)).norm(), 1e-9);
  EXPECT_LE((here.force_rate[1] - rate(0.0, step)).norm(), 1e-9);
}

// On an arc of radius 1 that is vertical inside the stretch, by 0.3 before it and 0.2 after it.
TEST(StretchLoad, ByLengthOfPlanIsExactAcrossAVerticalPlace) {
  const auto arc = arc_axis({std::cos(3.5), std::sin(3.5)}, {0.0, 1.0}, {1.0, 0.0});
  const ImperfectAxis shape(*arc, {});
  const LineLoad snow{.first = {0.0, -1.0}, .measure = LoadMeasure::plan};
  constexpr double vertical = 3.5 - pi, from = vertical - 0.3, to = vertical + 0.2;
  const StretchReference rest = stretch_reference(shape, from, to);
  const auto at = [&](double a, double b) {
    return StretchLoad(stretch_reference(shape, a, b), snow, a, b)
        .respond(Vec2::Zero(), rest.angles.front(), rest.chord, rest.angles.back());
  };
  const auto here = at(from, to);
  EXPECT_NEAR(here.force[1] + here.force[4], 2.0 - std::cos(0.3) - std::cos(0.2), 1e-9);
  constexpr double step = 1e-6;  // the rates leave out that the pieces of Gauss's rule move, by its remainder
  EXPECT_LE(((at(from + step, to).force - at(from - step, to).force) / (2.0 * step) - here.force_rate[0]).norm(), 1e-6);
  EXPECT_LE(((at(from, to + step).force - at(from, to - step).force) / (2.0 * step) - here.force_rate[1]).norm(), 1e-6);
}

TEST(TrussDistributedLoad, ItsForcesActAtTheEnds) {
  test::Numbers numbers(28);
  const Vec2 first(0.4, -1.0), second(0.2, 0.5);
  const TrussDistributedLoad element({first, second});
  const Vector u = numbers.vector(4);
  test::expect_derivatives(element, u);
  const Vector f = test::evaluated(element, u).f;
  EXPECT_EQ(Vec2(f.head(2)), Vec2(-first));
  EXPECT_EQ(Vec2(f.tail(2)), Vec2(-second));
}

}  // namespace arcwall::distributed_load_test
