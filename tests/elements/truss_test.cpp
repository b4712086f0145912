#include "elements/truss.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"

namespace arcwall::truss_test {

namespace {

constexpr double EA = 50.0;
const Vec2 chord(0.9, -1.2);  // length 1.5
constexpr TrussStrain all_strains[] = {TrussStrain::green, TrussStrain::engineering, TrussStrain::log};

}  // namespace

TEST(Truss, DerivativesAreConsistentForAllStrains) {
  test::Numbers numbers(25);
  for (const TrussStrain strain : all_strains) {
    test::expect_derivatives(Truss(chord, EA, strain), Vector::Zero(4));
    for (int i = 0; i < 10; ++i) test::expect_derivatives(Truss(chord, EA, strain), 0.5 * numbers.vector(4));
  }
}

TEST(Truss, RigidMotionsGiveNoForce) {
  for (const TrussStrain strain : all_strains)
    for (const double angle : {0.0, 1.0, 3.0, -4.0}) {
      const Vec2 shift(2.0, 1.0), turned = Eigen::Rotation2Dd(angle) * chord - chord;
      Vector u(4);
      u << shift, shift + turned;
      const auto moved = test::evaluated(Truss(chord, EA, strain), u);
      EXPECT_LE(moved.f.norm(), 1e-14 * EA);
      EXPECT_NEAR(moved.energy, 0.0, 1e-28 * EA);
    }
}

// N = EA ε dε/d(l/L) · … : the force along the bar is dU/dl, U = ½ EA L ε(l)².
TEST(Truss, ForceIsTheDerivativeOfTheStrainEnergyInTheLength) {
  const double L = chord.norm(), l = 1.25 * L;
  Vector u = Vector::Zero(4);
  u.tail(2) = 0.25 * chord;
  const auto force = [&](TrussStrain strain) {
    return test::evaluated(Truss(chord, EA, strain), u).f.tail(2).dot(chord.normalized());
  };
  EXPECT_NEAR(force(TrussStrain::green), EA * (l * l - L * L) / (2.0 * L * L) * l / L, 1e-13 * EA);
  EXPECT_NEAR(force(TrussStrain::engineering), EA * 0.25, 1e-13 * EA);
  EXPECT_NEAR(force(TrussStrain::log), EA * std::log(1.25) / 1.25, 1e-13 * EA);
}

TEST(Truss, TheThreeStrainsAgreeToFirstOrder) {
  Vector u = Vector::Zero(4);
  u.tail(2) = 1e-6 * chord;
  const Vector green = test::evaluated(Truss(chord, EA, TrussStrain::green), u).f;
  for (const TrussStrain strain : all_strains) {
    const Vector f = test::evaluated(Truss(chord, EA, strain), u).f;
    EXPECT_NEAR(f.tail(2).norm(), 1e-6 * EA, 3e-12 * EA);  // second order: 1.5 (1e-6)²
    EXPECT_LE((f - green).norm(), 5e-12 * EA);
  }
}

}  // namespace arcwall::truss_test
