#include "elements/elastica_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"
#include "tests/elements/slender_beam_checks.hpp"

// By places, with its rates and its places inside: slender_beam_test.cpp; its orders of convergence: order_test.cpp.
namespace arcwall::elastica_beam_test {

namespace {

using test::evaluated;
using test::expect_derivatives;
using test::Numbers;

constexpr double EA = 200.0, EI = 3.0;

// Straight, circular, and of no simple shape: about 1.2 long.
std::vector<StretchReference> stretches() {
  const auto line = straight_axis({0.0, 0.0}, {1.2, 0.5}), arc = arc_axis({0.0, 0.0}, {-0.5, 0.4}, {-0.6, 1.1}),
             sine = sine_axis({0.0, 0.0}, {2.0, 1.0}, 0.1, 2);
  const std::vector<SineDeviation> waves{{.amplitude = 0.03, .waves = 3}};
  return {stretch_reference(ImperfectAxis(*line, {}), 0.0, line->length()),
          stretch_reference(ImperfectAxis(*arc, {}), 0.0, arc->length()),
          stretch_reference(ImperfectAxis(*sine, waves), 0.4, 1.6)};
}

// For all stretches and both orders.
template <class Check>
void on_all(const Check& check) {
  for (const ElasticaOrder order : {ElasticaOrder::four, ElasticaOrder::six}) {
    int number = 0;
    for (const StretchReference& stretch : stretches()) {
      SCOPED_TRACE((order == ElasticaOrder::four ? "order 4, stretch " : "order 6, stretch ") +
                   std::to_string(number++));
      check(stretch, ElasticaBeam(stretch, EA, EI, order));
    }
  }
}

// The element moved as a rigid body: turned by `angle` about its first node and shifted.
Vector rigid_motion(const StretchReference& stretch, double angle, const Vec2& shift) {
  const Vec2 turned = Eigen::Rotation2Dd(angle) * stretch.chord - stretch.chord;
  Vector u(6);
  u << shift, angle, shift + turned, angle;
  return u;
}

}  // namespace

TEST(ElasticaBeam, DerivativesAreConsistent) {
  Numbers numbers(70);
  on_all([&](const StretchReference& stretch, const ElasticaBeam& beam) {
    expect_derivatives(beam, Vector::Zero(6));
    for (int i = 0; i < 5; ++i) expect_derivatives(beam, 0.3 * numbers.vector(6));
    for (const double angle : {2.0, -9.0, 50.0})
      expect_derivatives(beam, rigid_motion(stretch, angle, {0.4, -3.0}) + 0.2 * numbers.vector(6));
  });
}

TEST(ElasticaBeam, RigidMotionsOfAnyAngleGiveNoForce) {
  on_all([](const StretchReference& stretch, const ElasticaBeam& beam) {
    for (const double angle : {0.0, 0.1, 1.5, 3.0, 3.3, -4.0, 2.0 * pi, 17.0, -40.0}) {
      const auto moved = evaluated(beam, rigid_motion(stretch, angle, {3.0, -2.0}));
      // Displacements of size 5 and angles up to 40 are known to ε: EA/h and 6EI/h² of that remain.
      EXPECT_LE(moved.f.norm(), 1e-14 * 40.0 * (EA + 6.0 * EI));
      EXPECT_NEAR(moved.energy, 0.0, 1e-24 * EA * 40.0 * 40.0);
    }
  });
}

TEST(ElasticaBeam, StiffnessAtRestHasTheThreeRigidMotionsAndNoOther) {
  on_all([](const StretchReference&, const ElasticaBeam& beam) {
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(evaluated(beam, Vector::Zero(6)).K).eigenvalues();
    EXPECT_LE(values.head(3).cwiseAbs().maxCoeff(), 1e-12 * values[5]);
    EXPECT_GT(values[3], 1e-3 * values[5]);
  });
}

TEST(ElasticaBeam, ForcesAreIndifferentToRotationsOfTheWholeAndToWholeTurns) {
  Numbers numbers(71);
  on_all([&](const StretchReference& stretch, const ElasticaBeam& beam) {
    const Vector u = 0.3 * numbers.vector(6);
    const auto at = evaluated(beam, u);
    const double angle = 2.6;
    const Eigen::Rotation2Dd turn(angle);
    Vector v(6), f(6);
    v << turn * u.segment<2>(0), u[2] + angle + 4.0 * pi, turn * Vec2(stretch.chord + u.segment<2>(3)) - stretch.chord,
        u[5] + angle - 2.0 * pi;
    f << turn * at.f.segment<2>(0), at.f[2], turn * at.f.segment<2>(3), at.f[5];
    const auto after = evaluated(beam, v);
    EXPECT_NEAR(after.energy, at.energy, 1e-13 * EA);
    EXPECT_LE((after.f - f).norm(), 1e-13 * EA * 10.0);
  });
}

TEST(ElasticaBeam, ForcesOfAnElementBalance) {
  Numbers numbers(72);
  on_all([&](const StretchReference& stretch, const ElasticaBeam& beam) {
    const Vector u = 0.5 * numbers.vector(6);
    const Vector f = evaluated(beam, u).f;
    EXPECT_LE((f.segment<2>(0) + f.segment<2>(3)).norm(), 1e-14 * f.norm());
    const Vec2 arm = stretch.chord + u.segment<2>(3) - u.segment<2>(0);
    EXPECT_NEAR(f[2] + f[5] + arm.x() * f[4] - arm.y() * f[3], 0.0, 1e-13 * f.norm());
  });
}

// Small displacements of a straight beam: the stiffness of Euler and Bernoulli.
TEST(ElasticaBeam, LinearStiffnessIsThatOfTheTextbook) {
  constexpr double h = 0.8;
  const auto axis = straight_axis({0.0, 0.0}, {h, 0.0});
  for (const ElasticaOrder order : {ElasticaOrder::four, ElasticaOrder::six}) {
    const ElasticaBeam beam(stretch_reference(ImperfectAxis(*axis, {}), 0.0, h), EA, EI, order);
    const Matrix K = evaluated(beam, Vector::Zero(6)).K;
    EXPECT_NEAR(K(0, 0), EA / h, 1e-12 * EA);
    EXPECT_NEAR(K(3, 0), -EA / h, 1e-12 * EA);
    EXPECT_NEAR(K(1, 1), 12.0 * EI / (h * h * h), 1e-12 * EA);
    EXPECT_NEAR(K(2, 1), 6.0 * EI / (h * h), 1e-12 * EA);
    EXPECT_NEAR(K(2, 2), 4.0 * EI / h, 1e-12 * EA);
    EXPECT_NEAR(K(5, 2), 2.0 * EI / h, 1e-12 * EA);
  }
}

// The inner iteration finds its state for bends of up to 1.5 and skews of half of that, however thin the beam; chords
// are those of a quadratic angle, with a strain of up to 10 EI/h²/EA.
TEST(ElasticaBeam, BendsOfOneAndAHalfAreFound) {
  Numbers numbers(74);
  const auto axis = straight_axis({0.0, 0.0}, {1.0, 0.0});
  const StretchReference stretch = stretch_reference(ImperfectAxis(*axis, {}), 0.0, 1.0);
  for (const ElasticaOrder order : {ElasticaOrder::four, ElasticaOrder::six})
    for (const double slenderness : {1e2, 1e4, 1e8, 1e12}) {
      const ElasticaBeam beam(stretch, slenderness, 1.0, order);
      for (int i = 0; i < 200; ++i) {
        const double bend = 1.5 * numbers(), skew = 0.75 * numbers();
        const double strain = 10.0 * numbers() / slenderness;
        const double l = (1.0 + strain) / (1.0 + shortening(bend, 3.0 * skew).value);
        const double energy =
            test::response(beam, {.chord = {l, 0.0}, .angle1 = 0.5 * (skew - bend), .angle2 = 0.5 * (skew + bend)})
                .energy;
        EXPECT_TRUE(std::isfinite(energy)) << slenderness << " " << bend << " " << skew << " " << strain;
      }
    }
}

TEST(ElasticaBeam, WithoutAStateInsideNothingIsANumber) {
  const auto axis = straight_axis({0.0, 0.0}, {1.0, 0.0});
  const ElasticaBeam beam(stretch_reference(ImperfectAxis(*axis, {}), 0.0, 1.0), 1e4, 1.0, ElasticaOrder::six);
  Vector u = Vector::Zero(6);
  u[3] = -std::numeric_limits<double>::infinity();
  const auto at = evaluated(beam, u);
  EXPECT_TRUE(std::isnan(at.energy));
  EXPECT_TRUE(at.f.array().isNaN().all());
  EXPECT_TRUE(at.K.array().isNaN().all());
}

// On a circle of any bend the moment is EI (b − b⁰)/h, and nothing else acts.
TEST(ElasticaBeam, ACircleNeedsTheExactMoment) {
  const StretchReference stretch = stretches()[1];
  const double h = stretch.length, b_0 = stretch.angles[3] - stretch.angles[0];
  for (const ElasticaOrder order : {ElasticaOrder::four, ElasticaOrder::six}) {
    const ElasticaBeam beam(stretch, EA, EI, order);
    for (const double bend : {0.1, 0.6, -1.0}) {
      const double l = h * std::sin(0.5 * bend) / (0.5 * bend);
      const BeamResponse at =
          test::response(beam, {.chord = {0.0, l}, .angle1 = 0.5 * (pi - bend), .angle2 = 0.5 * (pi + bend)});
      EXPECT_LE(at.force.head<2>().norm(), 1e-13 * EA);
      EXPECT_NEAR(at.force[2], -EI * (bend - b_0) / h, 1e-13 * EA);
      EXPECT_NEAR(at.force[3], EI * (bend - b_0) / h, 1e-13 * EA);
    }
  }
}

}  // namespace arcwall::elastica_beam_test
