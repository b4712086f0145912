#include "elements/distributed_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/axis.hpp"
#include "tests/elements/element_checks.hpp"

namespace arcwall::distributed_load_test {

namespace {

BeamReference curved() {
  constexpr double half = 0.4;
  const Vec2 chord(1.0, 0.7);
  return {.chord = chord, .length = chord.norm() * half / std::sin(half), .slope1 = half, .slope2 = -half};
}

const Vec2 load(0.8, -2.0);

}  // namespace

TEST(BeamDistributedLoad, DerivativesAreConsistent) {
  test::Numbers numbers(26);
  const BeamDistributedLoad element(curved(), load);
  for (int i = 0; i < 5; ++i) test::expect_derivatives(element, numbers.vector(6));
}

TEST(BeamDistributedLoad, ForcesAddUpToTheLoadAndTheirMomentIsThatAtTheMeanPosition) {
  test::Numbers numbers(27);
  const BeamReference reference = curved();
  const Vector u = numbers.vector(6);
  const Vector f = test::evaluated(BeamDistributedLoad(reference, load), u).f;
  const Vec2 resultant = reference.length * load;
  EXPECT_LE((f.segment<2>(0) + f.segment<2>(3) + resultant).norm(), 1e-14);
  // About node 1, at the origin; the mean of Hermite's cubic with end angles φ against the undeformed chord's direction
  // of rest is half the chord plus its normal times (φ1 − φ2)/12.
  const Vec2 chord = reference.chord + u.segment<2>(3) - u.segment<2>(0);
  const double bend = (reference.slope1 + u[2] - reference.slope2 - u[5]) / 12.0;
  const Vec2 mean = 0.5 * chord + bend * perp(chord);
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  EXPECT_NEAR(f[2] + f[5] + cross(chord, f.segment<2>(3)), -cross(mean, resultant), 1e-13);
}

TEST(BeamDistributedLoad, OnAStraightBeamEquivalentForcesAreThoseOfTheTextbook) {
  constexpr double h = 0.8, q = 3.0;
  const BeamDistributedLoad element({.chord = {h, 0.0}, .length = h, .slope1 = 0.0, .slope2 = 0.0}, {0.0, q});
  const Vector f = -test::evaluated(element, Vector::Zero(6)).f;
  EXPECT_NEAR(f[1], q * h / 2.0, 1e-14);
  EXPECT_NEAR(f[4], q * h / 2.0, 1e-14);
  EXPECT_NEAR(f[2], q * h * h / 12.0, 1e-14);
  EXPECT_NEAR(f[5], -q * h * h / 12.0, 1e-14);
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
  EXPECT_EQ(here.stiffness, here.stiffness.transpose());
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

TEST(StretchLoad, ActsAsTheLoadByDisplacements) {
  test::Numbers numbers(30);
  const auto axis = straight_axis({1.0, 2.0}, {4.0, 6.0});
  const StretchReference stretch = stretch_reference(ImperfectAxis(*axis, {}), 1.0, 3.0);
  const BeamDistributedLoad by_displacement({.chord = stretch.chord, .length = 2.0, .slope1 = 0.0, .slope2 = 0.0},
                                            load);
  const Vector u = numbers.vector(6);
  const Vec2 r1(1.6, 2.8);
  const auto by_place = StretchLoad(stretch, load)
                            .respond(r1 + u.head<2>(), u[2] + 1.0, r1 + stretch.chord + u.segment<2>(3), u[5] + 1.0);
  const auto expected = test::evaluated(by_displacement, u);
  EXPECT_LE((by_place.force - expected.f).norm(), 1e-14);
  EXPECT_LE((by_place.stiffness - expected.K).norm(), 1e-14);
}

TEST(TrussDistributedLoad, HalfOfItActsAtEachEnd) {
  test::Numbers numbers(28);
  const TrussDistributedLoad element(load);
  const Vector u = numbers.vector(4);
  test::expect_derivatives(element, u);
  const Vector f = test::evaluated(element, u).f;
  EXPECT_EQ(Vec2(f.head(2)), Vec2(-0.5 * load));
  EXPECT_EQ(Vec2(f.tail(2)), Vec2(-0.5 * load));
}

}  // namespace arcwall::distributed_load_test
