#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "elements/updated_classic_beam.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/in_increments.hpp"

// The incremental updated Lagrangian scheme of Selke & Kikuchi against the equations it approximates.
namespace arcwall::increments_test {

namespace {

using test::InIncrements;

constexpr int elements = 80;

InIncrements foundation_beam() {
  return {test::foundation_structure(elements),
          test::foundation_wall(),
          {.method = ContactLaw::Method::penalty, .stiffness = 1e9}};
}

double depth_of_middle(const InIncrements& beam) { return -beam.z_of(elements / 2); }

}  // namespace

// Before contact the beam is a circular arc, 1 − cos k over k deep, k = M/2.8: 0.0713072 at M = 0.4. The scheme does
// not iterate: it falls behind by what is of first order in the increment.
TEST(LoadIncrements, BendABeamWithAnErrorOfFirstOrderInTheIncrement) {
  const double k = 0.4 / 2.8, exact = (1.0 - std::cos(k)) / k;
  std::vector<double> sizes, errors;
  for (const int increments : {5, 10, 20, 40}) {
    sizes.push_back(1.0 / increments);
    InIncrements beam = foundation_beam();
    beam.load_to(0.4, 0.4 / increments);
    errors.push_back(depth_of_middle(beam) - exact);
    EXPECT_EQ(beam.unsettled(), 0);
  }
  EXPECT_GE(test::observed_order(sizes, errors), 1.0);
  EXPECT_LE(std::abs(errors.back()), 1e-5);
  EXPECT_GE(std::abs(errors.front()), 1e-5) << "results depend on the increments";
}

// Their Table 1, classic theory: the printed depth of the middle before contact and on the foundation.
TEST(LoadIncrements, FindTheClassicColumnOfTable1) {
  InIncrements beam = foundation_beam();
  for (const auto& [moment, printed] : {std::pair{0.4, 0.0715},
                                        {0.4475, 0.0799},
                                        {0.4485, 0.0800},
                                        {0.4495, 0.0800},
                                        {0.5, 0.0800},
                                        {2.5, 0.0800},
                                        {3.0, 0.0800},
                                        {3.5, 0.0800},
                                        {5.0, 0.0800},
                                        {5.18, 0.0800}}) {
    beam.load_to(moment, 0.0125);
    EXPECT_NEAR(depth_of_middle(beam), printed, 2e-4) << moment;
  }
  EXPECT_EQ(beam.unsettled(), 0);
}

TEST(LoadIncrements, CarryTheirResidueIntoTheNextIncrement) {
  InIncrements beam = foundation_beam();
  beam.load_to(0.3, 0.3);
  double before = beam.last().residual;
  EXPECT_GE(before, 1e-3);
  // Increments without load relax what is left.
  for (int i = 0; i < 3; ++i) {
    beam.relax(1);
    EXPECT_LE(beam.last().residual, 0.1 * before);
    before = beam.last().residual;
  }
}

// Increments are referred to the present chord: a rotation of the whole changes no stress, a stretch does by EA times
// Green's strain, brought to the new length.
TEST(UpdatedClassicBeam, CarriesItsStressesAlong) {
  const double EA = 210.0, EI = 0.175, l = 0.5;
  const Vec2 chord(l, 0.0);
  const double at_rest[6] = {};
  const UpdatedClassicBeam beam(at_rest, chord, {.N = -3.0, .M1 = 0.4, .M2 = -0.2}, EA, EI);
  const double angle = 0.7;
  const Vec2 turned = l * Vec2(std::cos(angle), std::sin(angle)) - chord;
  const double rigid[6] = {0.1, -0.2, angle, 0.1 + turned.x(), -0.2 + turned.y(), angle};
  const auto moved = beam.updated(rigid);
  const auto& stresses = dynamic_cast<const UpdatedClassicBeam&>(*moved).stresses();
  EXPECT_NEAR(stresses.N, -3.0, 1e-12);
  EXPECT_NEAR(stresses.M1, 0.4, 1e-14);
  EXPECT_NEAR(stresses.M2, -0.2, 1e-14);

  const double pulled[6] = {0.0, 0.0, 0.0, 0.01 * l, 0.0, 0.0};
  const auto longer = beam.updated(pulled);
  const double green = 0.01 + 0.5 * 0.01 * 0.01;
  EXPECT_NEAR(dynamic_cast<const UpdatedClassicBeam&>(*longer).stresses().N, (-3.0 + EA * green) * 1.01, 1e-12);

  const double bent[6] = {0.0, 0.0, -0.02, 0.0, 0.0, 0.03};
  const auto curved = beam.updated(bent);
  const auto& after = dynamic_cast<const UpdatedClassicBeam&>(*curved).stresses();
  EXPECT_NEAR(after.M1, 0.4 + EI / l * (4.0 * -0.02 + 2.0 * 0.03), 1e-14);
  EXPECT_NEAR(after.M2, -0.2 + EI / l * (2.0 * -0.02 + 4.0 * 0.03), 1e-14);
}

// The stiffness is the derivative of the forces of what follows, and symmetric; its energy is that of the increments.
TEST(UpdatedClassicBeam, IsLinearBetweenIncrements) {
  test::Numbers numbers(90);
  const double u0[6] = {0.1, 0.2, 0.3, 0.15, 0.1, -0.2};
  const UpdatedClassicBeam beam(u0, {0.4, 0.3}, {.N = 2.0, .M1 = 0.3, .M2 = 0.1}, 100.0, 1.0, 5.0);
  const Vector u = Eigen::Map<const Vector>(u0, 6) + 0.1 * numbers.vector(6);
  Vector f(6), f0(6);
  Matrix K(6, 6);
  EXPECT_DOUBLE_EQ(beam.evaluate(u0, f0.data(), K.data()), 5.0);
  EXPECT_LE((K - K.transpose()).norm(), 1e-12 * K.norm());
  const double U = beam.evaluate(u.data(), f.data(), nullptr);
  const Vector du = u - Eigen::Map<const Vector>(u0, 6);
  EXPECT_LE((f - f0 - K * du).norm(), 1e-12 * f.norm());
  EXPECT_NEAR(U, 5.0 + 0.5 * du.dot(f + f0), 1e-12);
}

}  // namespace arcwall::increments_test
