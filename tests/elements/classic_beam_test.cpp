#include "elements/classic_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"

namespace arcwall::classic_beam_test {

namespace {

using test::evaluated;
using test::expect_derivatives;
using test::Numbers;

constexpr double EA = 200.0, EI = 3.0;

BeamReference straight() { return {.chord = {1.2, 0.5}, .length = 1.3, .slope1 = 0.0, .slope2 = 0.0}; }

// A circular arc of half angle 0.4 over the chord.
BeamReference curved() {
  constexpr double half = 0.4;
  const Vec2 chord(-0.6, 1.1);
  return {.chord = chord, .length = chord.norm() * half / std::sin(half), .slope1 = half, .slope2 = -half};
}

// The element moved as a rigid body: turned by `angle` about its first node and shifted.
Vector rigid_motion(const BeamReference& reference, double angle, const Vec2& shift) {
  const Vec2 turned = Eigen::Rotation2Dd(angle) * reference.chord - reference.chord;
  Vector u(6);
  u << shift, angle, shift + turned, angle;
  return u;
}

}  // namespace

TEST(ClassicBeam, DerivativesAreConsistentStraightAndCurved) {
  Numbers numbers(20);
  for (const BeamReference& reference : {straight(), curved()}) {
    const ClassicBeam beam(reference, EA, EI);
    expect_derivatives(beam, Vector::Zero(6));
    for (int i = 0; i < 10; ++i) expect_derivatives(beam, 0.3 * numbers.vector(6));
  }
}

TEST(ClassicBeam, DerivativesAreConsistentAfterManyTurns) {
  Numbers numbers(21);
  for (const BeamReference& reference : {straight(), curved()})
    for (const double angle : {2.0, 3.3, -9.0, 50.0}) {
      SCOPED_TRACE(angle);
      const Vector u = rigid_motion(reference, angle, {0.4, -3.0}) + 0.2 * numbers.vector(6);
      expect_derivatives(ClassicBeam(reference, EA, EI), u);
    }
}

TEST(ClassicBeam, RigidMotionsOfAnyAngleGiveNoForce) {
  for (const BeamReference& reference : {straight(), curved()}) {
    const ClassicBeam beam(reference, EA, EI);
    for (const double angle : {0.0, 0.1, 1.5, 3.0, 3.3, -4.0, 2.0 * pi, 17.0, -40.0}) {
      SCOPED_TRACE(angle);
      const auto moved = evaluated(beam, rigid_motion(reference, angle, {3.0, -2.0}));
      // Displacements of size 5 and angles up to 40 are known to ε: EA/h and 6EI/h² of that remain.
      const double roundoff = 1e-15 * 40.0 * (EA + 6.0 * EI);
      EXPECT_LE(moved.f.norm(), 10.0 * roundoff);
      EXPECT_NEAR(moved.energy, 0.0, 1e-24 * EA * 40.0 * 40.0);
    }
  }
}

TEST(ClassicBeam, StiffnessAtRestHasTheThreeRigidMotionsAndNoOther) {
  for (const BeamReference& reference : {straight(), curved()}) {
    const Matrix K = evaluated(ClassicBeam(reference, EA, EI), Vector::Zero(6)).K;
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues();
    EXPECT_LE(values.head(3).cwiseAbs().maxCoeff(), 1e-12 * values[5]);
    EXPECT_GT(values[3], 1e-3 * values[5]);
  }
}

TEST(ClassicBeam, ForcesAreIndifferentToRotationsOfTheWhole) {
  Numbers numbers(22);
  for (const BeamReference& reference : {straight(), curved()}) {
    const ClassicBeam beam(reference, EA, EI);
    const Vector u = 0.3 * numbers.vector(6);
    const auto at = evaluated(beam, u);
    const double angle = 2.6;
    const Eigen::Rotation2Dd turn(angle);
    Vector v(6), f(6);
    v << turn * u.segment<2>(0), u[2] + angle, turn * Vec2(reference.chord + u.segment<2>(3)) - reference.chord,
        u[5] + angle;
    f << turn * at.f.segment<2>(0), at.f[2], turn * at.f.segment<2>(3), at.f[5];
    const auto after = evaluated(beam, v);
    EXPECT_NEAR(after.energy, at.energy, 1e-13 * EA);
    EXPECT_LE((after.f - f).norm(), 1e-13 * EA * 10.0);
  }
}

// The same place reached after another number of whole turns of the nodes.
TEST(ClassicBeam, TheStateDoesNotDependOnTheTurnsThatLedToIt) {
  Numbers numbers(23);
  const ClassicBeam beam(curved(), EA, EI);
  for (const double angle : {0.5, 3.0}) {
    const Vector u = rigid_motion(curved(), angle, {1.0, 2.0}) + 0.3 * numbers.vector(6);
    const auto at = evaluated(beam, u);
    for (const int turns : {-3, 1, 5}) {
      Vector v = u;
      v[2] += 2.0 * pi * turns;
      v[5] += 2.0 * pi * turns;
      const auto again = evaluated(beam, v);
      // Angles of size 30 are known to 30 ε.
      EXPECT_NEAR(again.energy, at.energy, 1e-13 * EA);
      EXPECT_LE((again.f - at.f).norm(), 1e-12 * EA);
      EXPECT_LE((again.K - at.K).norm(), 1e-12 * at.K.norm());
    }
  }
}

TEST(ClassicBeam, ForcesOfAnElementBalance) {
  Numbers numbers(24);
  const BeamReference reference = curved();
  const Vector u = 0.5 * numbers.vector(6);
  const Vector f = evaluated(ClassicBeam(reference, EA, EI), u).f;
  EXPECT_LE((f.segment<2>(0) + f.segment<2>(3)).norm(), 1e-14 * f.norm());
  const Vec2 arm = reference.chord + u.segment<2>(3) - u.segment<2>(0);
  EXPECT_NEAR(f[2] + f[5] + arm.x() * f[4] - arm.y() * f[3], 0.0, 1e-13 * f.norm());
}

// Small displacements of a straight beam: the stiffness of Euler and Bernoulli.
TEST(ClassicBeam, LinearStiffnessIsThatOfTheTextbook) {
  constexpr double h = 0.8;
  const Matrix K =
      evaluated(ClassicBeam({.chord = {h, 0.0}, .length = h, .slope1 = 0.0, .slope2 = 0.0}, EA, EI), Vector::Zero(6)).K;
  EXPECT_NEAR(K(0, 0), EA / h, 1e-12 * EA);
  EXPECT_NEAR(K(3, 0), -EA / h, 1e-12 * EA);
  EXPECT_NEAR(K(1, 1), 12.0 * EI / (h * h * h), 1e-12 * EA);
  EXPECT_NEAR(K(2, 1), 6.0 * EI / (h * h), 1e-12 * EA);
  EXPECT_NEAR(K(2, 2), 4.0 * EI / h, 1e-12 * EA);
  EXPECT_NEAR(K(5, 2), 2.0 * EI / h, 1e-12 * EA);
}

// On a circle, chord l = h sin α/α and end slopes ∓α, the moment is EI 2α/h and nothing else acts. The element's
// stretch is that of α/sin α = 1 + α²/6 + 7α⁴/360 + 31α⁶/15120 + … up to the fourth power.
TEST(ClassicBeam, ACircleNeedsTheExactMoment) {
  constexpr double h = 1.0;
  const ClassicBeam beam({.chord = {h, 0.0}, .length = h, .slope1 = 0.0, .slope2 = 0.0}, EA, EI);
  for (const double alpha : {0.02, 0.1, 0.3}) {
    Vector u(6);
    u << 0.0, 0.0, -alpha, h * std::sin(alpha) / alpha - h, 0.0, alpha;
    const Vector f = evaluated(beam, u).f;
    const double axial = 1.1 * EA * 31.0 / 15120.0 * std::pow(alpha, 6) + 1e-15 * EA;
    EXPECT_NEAR(f[5], EI * 2.0 * alpha / h, axial * alpha + 1e-14 * EA);
    EXPECT_NEAR(f[2], -EI * 2.0 * alpha / h, axial * alpha + 1e-14 * EA);
    EXPECT_NEAR(f[3], 0.0, axial);
    EXPECT_NEAR(f[4], 0.0, 1e-14 * EA);
  }
}

}  // namespace arcwall::classic_beam_test
