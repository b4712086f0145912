#include "elements/reissner_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"

namespace arcwall::exact_beam_test {

namespace {

using test::evaluated;
using test::expect_derivatives;
using test::Numbers;

constexpr ExactBeamStiffness stiffness{.EA = 200.0, .GA = 70.0, .EI = 3.0};

// A stretch of a circle that turns from −half to half about its chord, or straight where half = 0; of unequal parts.
ExactBeamReference stretch(int order, double half) {
  constexpr double length = 1.3, direction = 0.7;
  const auto at = [&](double s) {
    const double a = half * (1.0 - 2.0 * s / length);  // tangent against the chord
    const Vec2 along =
        half == 0.0 ? Vec2(s, 0.0)
                    : Vec2(length / (2.0 * half) * Vec2(std::sin(half) - std::sin(a), std::cos(a) - std::cos(half)));
    return Vec2(Eigen::Rotation2Dd(direction) * along);
  };
  ExactBeamReference reference;
  for (const double s : order == 1 ? std::vector{0.0, length} : std::vector{0.0, 0.53 * length, length}) {
    reference.nodes.push_back(at(s));
    reference.arcs.push_back(s);
  }
  return reference;
}

std::vector<ExactBeamReference> stretches() {
  return {stretch(1, 0.0), stretch(1, 0.4), stretch(2, 0.0), stretch(2, 0.4)};
}

// The element moved as a rigid body: turned by `angle` about its first node and shifted.
Vector rigid_motion(const ExactBeamReference& reference, double angle, const Vec2& shift) {
  Vector u(3 * (reference.order() + 1));
  for (std::size_t a = 0; a < reference.nodes.size(); ++a)
    u.segment<3>(static_cast<Index>(3 * a))
        << shift + Eigen::Rotation2Dd(angle) * reference.nodes[a] - reference.nodes[a],
        angle;
  return u;
}

}  // namespace

TEST(ReissnerBeam, DerivativesAreConsistentStraightAndCurved) {
  Numbers numbers(30);
  for (const ExactBeamReference& reference : stretches()) {
    const ReissnerBeam beam(reference, stiffness);
    const Index n = beam.unknown_count();
    expect_derivatives(beam, Vector::Zero(n));
    for (int i = 0; i < 10; ++i) expect_derivatives(beam, 0.5 * numbers.vector(n));
    for (const double angle : {2.0, -9.0, 50.0})
      expect_derivatives(beam, rigid_motion(reference, angle, {0.4, -3.0}) + 0.2 * numbers.vector(n));
  }
}

TEST(ReissnerBeam, RigidMotionsOfAnyAngleGiveNoForce) {
  for (const ExactBeamReference& reference : stretches()) {
    const ReissnerBeam beam(reference, stiffness);
    for (const double angle : {0.0, 0.1, 1.5, 3.0, 3.3, -4.0, 2.0 * pi, 17.0, -40.0}) {
      SCOPED_TRACE(angle);
      const auto moved = evaluated(beam, rigid_motion(reference, angle, {3.0, -2.0}));
      // Displacements of size 5 and angles up to 40 are known to ε.
      const double roundoff = 1e-15 * 40.0 * stiffness.EA;
      EXPECT_LE(moved.f.norm(), 10.0 * roundoff);
      EXPECT_NEAR(moved.energy, 0.0, 1e-24 * stiffness.EA * 40.0 * 40.0);
    }
  }
}

// Reduced integration leaves no motion without energy but the rigid ones.
TEST(ReissnerBeam, StiffnessAtRestHasTheThreeRigidMotionsAndNoOther) {
  for (const ExactBeamReference& reference : stretches()) {
    const Matrix K = evaluated(ReissnerBeam(reference, stiffness), Vector::Zero(3 * (reference.order() + 1))).K;
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues();
    EXPECT_LE(values.head(3).cwiseAbs().maxCoeff(), 1e-12 * values[values.size() - 1]);
    EXPECT_GT(values[3], 1e-3 * values[values.size() - 1]);
  }
}

TEST(ReissnerBeam, ForcesAreIndifferentToRotationsOfTheWhole) {
  Numbers numbers(31);
  for (const ExactBeamReference& reference : stretches()) {
    const ReissnerBeam beam(reference, stiffness);
    const Vector u = 0.5 * numbers.vector(beam.unknown_count());
    const auto at = evaluated(beam, u);
    const double angle = 2.6;
    const Eigen::Rotation2Dd turn(angle);
    Vector v = u, f = at.f;
    for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
      const auto i = static_cast<Index>(3 * a);
      v.segment<2>(i) = turn * Vec2(reference.nodes[a] + u.segment<2>(i)) - reference.nodes[a];
      v[i + 2] += angle;
      f.segment<2>(i) = turn * Vec2(at.f.segment<2>(i));
    }
    const auto after = evaluated(beam, v);
    EXPECT_NEAR(after.energy, at.energy, 1e-13 * stiffness.EA);
    EXPECT_LE((after.f - f).norm(), 1e-13 * stiffness.EA * 10.0);
  }
}

// Stretched by e, sheared by g and bent by k, all constant: resultants are the stiffnesses times these, at any
// rotation.
TEST(ReissnerBeam, ConstantStrainsGiveTheirExactForces) {
  constexpr double e = 0.1, g = -0.2, turn = 1.9;
  for (const int order : {1, 2}) {
    const ExactBeamReference reference = stretch(order, 0.0);
    const Vec2 axis = reference.nodes.back().normalized();
    const Eigen::Rotation2Dd rotation(turn);
    const Vec2 t = rotation * axis, n = perp(t);
    Vector u(3 * (order + 1));
    for (std::size_t a = 0; a < reference.nodes.size(); ++a)
      u.segment<3>(static_cast<Index>(3 * a)) << reference.arcs[a] * ((1.0 + e) * t + g * n) - reference.nodes[a], turn;
    const Vector f = evaluated(ReissnerBeam(reference, stiffness), u).f;
    const Vec2 force = stiffness.EA * e * t + stiffness.GA * g * n;
    EXPECT_LE((f.segment<2>(f.size() - 3) - force).norm(), 1e-13 * stiffness.EA);
    EXPECT_LE((f.segment<2>(0) + force).norm(), 1e-13 * stiffness.EA);
    // The moments at the ends balance the couple of the forces.
    const Vec2 r = reference.arcs.back() * ((1.0 + e) * t + g * n);
    double moments = 0.0;
    for (Index i = 2; i < f.size(); i += 3) moments += f[i];
    EXPECT_NEAR(moments, -(r.x() * force.y() - r.y() * force.x()), 1e-13 * stiffness.EA);
  }
}

TEST(ExactDistributedLoad, IsLinearAndItsForcesAddUp) {
  Numbers numbers(32);
  const Vec2 load(0.8, -2.0);
  for (const ExactBeamReference& reference : stretches()) {
    const ExactDistributedLoad element(reference, [&](double) { return load; });
    const Vector u = numbers.vector(element.unknown_count());
    expect_derivatives(element, u);
    const auto at = evaluated(element, u);
    EXPECT_EQ(at.K, Matrix::Zero(u.size(), u.size()));
    Vec2 sum = Vec2::Zero();
    for (Index i = 0; i < u.size(); i += 3) sum += at.f.segment<2>(i);
    EXPECT_LE((sum + reference.arcs.back() * load).norm(), 1e-14);
  }
}

// Equal parts: a sixth, four sixths, a sixth, which is Simpson's rule.
TEST(ExactDistributedLoad, OfOrderTwoIsSharedAsInSimpsonsRule) {
  const ExactDistributedLoad element({.nodes = {{0, 0}, {1, 0}, {2, 0}}, .arcs = {0.0, 1.0, 2.0}},
                                     [](double) { return Vec2(0.0, 3.0); });
  const Vector f = -evaluated(element, Vector::Zero(9)).f;
  EXPECT_NEAR(f[1], 1.0, 1e-14);
  EXPECT_NEAR(f[4], 4.0, 1e-14);
  EXPECT_NEAR(f[7], 1.0, 1e-14);
}

}  // namespace arcwall::exact_beam_test
