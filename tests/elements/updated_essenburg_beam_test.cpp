#include "elements/updated_essenburg_beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/elements/element_checks.hpp"

namespace arcwall::updated_essenburg_beam_test {

namespace {

using test::evaluated;
using test::Numbers;

constexpr double E = 3.0, nu = 0.29, height = 0.25, width = 0.4, length = 0.6;

EssenburgReference straight(int order, QuadraticTerm quadratic) {
  EssenburgReference reference;
  for (int a = 0; a <= order; ++a) {
    reference.nodes.emplace_back(length * a / order, 0.0);
    reference.sections.push_back({.quadratic = quadratic});
  }
  return reference;
}

std::vector<EssenburgBeam> beams() {
  std::vector<EssenburgBeam> all;
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
    for (const int order : {1, 2})
      all.emplace_back(straight(order, quadratic),
                       EssenburgStiffness{.E = E, .nu = nu, .points = rectangle_points(width, height)});
  return all;
}

const UpdatedEssenburgBeam& as_updated(const Element& element) {
  return dynamic_cast<const UpdatedEssenburgBeam&>(element);
}

}  // namespace

TEST(UpdatedEssenburgBeam, BeginsWithTheStiffnessAtRest) {
  for (const EssenburgBeam& beam : beams()) {
    const Vector rest = Vector::Zero(beam.unknown_count());
    const auto expected = evaluated(beam, rest), begun = evaluated(*beam.updated(rest.data()), rest);
    EXPECT_EQ(begun.f, rest);
    EXPECT_LE((begun.K - expected.K).norm(), 1e-14 * expected.K.norm());
  }
}

// Two small increments have the stresses of the total strain but for terms of second order: the forces of both forms
// differ by the strain, relative to themselves.
TEST(UpdatedEssenburgBeam, HasTheStressesOfTheTotalStrainWhereThatIsSmall) {
  Numbers numbers(85);
  for (const EssenburgBeam& beam : beams()) {
    const Vector direction = numbers.vector(beam.unknown_count()), rest = Vector::Zero(direction.size());
    const auto difference = [&](double size) {
      const Vector u = size * direction, half = 0.5 * u;
      const auto moved = beam.updated(rest.data())->updated(half.data())->updated(u.data());
      const Vector total = evaluated(beam, u).f;
      return (evaluated(*moved, u).f - total).norm() / total.norm();
    };
    EXPECT_LE(difference(1e-4), 1e-2);
    EXPECT_NEAR(difference(1e-3) / difference(1e-4), 10.0, 1.0);
  }
}

// One increment from rest has the second stresses of Piola and Kirchhoff of the total form: the same forces exactly.
TEST(UpdatedEssenburgBeam, OneIncrementFromRestIsTheTotalForm) {
  Numbers numbers(86);
  for (const EssenburgBeam& beam : beams()) {
    const Vector u = 0.1 * numbers.vector(beam.unknown_count()), rest = Vector::Zero(u.size());
    const auto total = evaluated(beam, u), updated = evaluated(*beam.updated(rest.data())->updated(u.data()), u);
    EXPECT_LE((updated.f - total.f).norm(), 1e-13 * total.f.norm());
    EXPECT_NEAR(updated.energy, total.energy, 1e-13 * total.energy);
  }
}

// A rotation of the whole in one increment turns the stresses of Cauchy and changes nothing else, z² ξ along the
// director.
TEST(UpdatedEssenburgBeam, CarriesItsStressesAlong) {
  Numbers numbers(87);
  const EssenburgReference reference = straight(2, QuadraticTerm::director);
  const EssenburgBeam beam(reference, {.E = E, .nu = nu, .points = rectangle_points(width, height)});
  const Vector u = 0.1 * numbers.vector(15), rest = Vector::Zero(15);
  const auto strained = beam.updated(rest.data())->updated(u.data());
  const double angle = 0.7;
  const Eigen::Rotation2Dd turn(angle);
  Vector v = u;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto i = static_cast<Index>(5 * a);
    v.segment<2>(i) = turn * Vec2(reference.nodes[a] + u.segment<2>(i)) - reference.nodes[a];
    v[i + 2] += angle;
  }
  const auto turned = strained->updated(v.data());
  const auto &before = as_updated(*strained).stresses(), &after = as_updated(*turned).stresses();
  const Eigen::Matrix2d R = turn.toRotationMatrix();
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LE((after[i] - R * before[i] * R.transpose()).norm(), 1e-13 * E);
  EXPECT_NEAR(evaluated(*turned, v).energy, evaluated(*strained, u).energy, 1e-14);
}

// K is the derivative of the forces between infinitesimal increments: K_L of the stresses' change, K_σ of the turning
// of what is there.
TEST(UpdatedEssenburgBeam, StiffnessIsTheRateOfTheForcesOfTheNextIncrement) {
  Numbers numbers(88);
  constexpr double step = 1e-5;
  for (const EssenburgBeam& beam : beams()) {
    const Vector u = 0.1 * numbers.vector(beam.unknown_count()), rest = Vector::Zero(u.size());
    const auto here = beam.updated(rest.data())->updated(u.data());
    const auto at = evaluated(*here, u);
    for (Index i = 0; i < u.size(); ++i) {
      Vector above = u, below = u;
      above[i] += step;
      below[i] -= step;
      const Vector rate =
          (evaluated(*here->updated(above.data()), above).f - evaluated(*here->updated(below.data()), below).f) /
          (2.0 * step);
      EXPECT_LE((rate - at.K.col(i)).norm(), 1e-8 * at.K.norm());
    }
  }
}

}  // namespace arcwall::updated_essenburg_beam_test
