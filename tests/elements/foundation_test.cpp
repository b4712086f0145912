#include "elements/foundation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/structure.hpp"
#include "tests/elements/element_checks.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/models.hpp"

namespace arcwall::foundation_element_test {

namespace {

const Vec2 stiffness(0.7, 1.9);

// Linear in x, and in z a law with a maximum besides.
FoundationLaw bent_law() {
  FoundationLaw law(stiffness);
  law.add(1, std::make_shared<const SpringLaw>(std::vector{-2.0, -0.5, 0.0, 0.3, 2.0},
                                               std::vector{-0.2, -0.7, 0.0, 0.4, 0.9}));
  return law;
}

// An arc with a wave.
struct BentShape {
  std::unique_ptr<Axis> arc = arc_axis({0.0, 0.0}, {1.0, 0.3}, {2.0, 0.0});
  ImperfectAxis shape{*arc, {{.amplitude = 0.05, .waves = 2}}};
};

ExactBeamReference bent_reference(int order) {
  ExactBeamReference reference{.nodes = {Vec2(0.0, 0.0)}, .arcs = {0.0}};
  if (order == 2) {
    reference.nodes.emplace_back(0.5, 0.1);
    reference.arcs.push_back(0.52);
  }
  reference.nodes.emplace_back(1.0, 0.1);
  reference.arcs.push_back(1.03);
  return reference;
}

// A straight beam of length L without supports but one in x, on a foundation k in z, under P in its middle.
double middle_deflection(const test::BeamTheory& theory, double EI, double GA, double L, double k, double P,
                         int elements) {
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({L, 0.0});
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {L, 0.0}),
                      .theory = theory.theory,
                      .order = theory.order,
                      .section = test::section_of(1000.0, EI, GA),
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.add_foundation(0, {0.0, k});
  const Index middle = builder.dof(builder.mesh(0).nodes[static_cast<std::size_t>(elements / 2)], Dof::z);
  builder.add_load(middle, P, LoadKind::proportional);
  const auto structure = builder.build();
  const State loaded = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 1);
  return structure->value(loaded, middle);
}

}  // namespace

TEST(Foundation, DerivativesAreConsistent) {
  test::Numbers numbers(91);
  const BentShape bent;
  const BeamFoundation beam(stretch_reference(bent.shape, 0.4, 0.9), stiffness);
  for (int i = 0; i < 5; ++i) test::expect_derivatives(beam, 0.5 * numbers.vector(6));
  for (const int order : {1, 2})
    for (const int unknowns : {3, 5})
      test::expect_derivatives(ExactFoundation(bent_reference(order), stiffness, unknowns),
                               numbers.vector(unknowns * (order + 1)));
}

TEST(Foundation, DerivativesOfALawAreConsistent) {
  test::Numbers numbers(93);
  const BentShape bent;
  const BeamFoundation beam(stretch_reference(bent.shape, 0.4, 0.9), bent_law());
  for (int i = 0; i < 5; ++i) test::expect_derivatives(beam, 0.5 * numbers.vector(6));
  for (const int order : {1, 2})
    for (const int unknowns : {3, 5})
      test::expect_derivatives(ExactFoundation(bent_reference(order), bent_law(), unknowns),
                               0.5 * numbers.vector(unknowns * (order + 1)));
}

TEST(Foundation, OfEqualLawsIsEqual) {
  EXPECT_EQ(bent_law(), bent_law());
  EXPECT_NE(bent_law(), FoundationLaw(stiffness));
  FoundationLaw other(stiffness);
  other.add(0, std::make_shared<const SpringLaw>(std::vector{-2.0, -0.5, 0.0, 0.3, 2.0},
                                                 std::vector{-0.2, -0.7, 0.0, 0.4, 0.9}));
  EXPECT_NE(bent_law(), other);
}

TEST(Foundation, IsStressFreeAtRest) {
  const BentShape bent;
  const auto at_rest =
      test::evaluated(BeamFoundation(stretch_reference(bent.shape, 0.4, 0.9), stiffness), Vector::Zero(6));
  EXPECT_EQ(at_rest.energy, 0.0);
  EXPECT_EQ(at_rest.f.norm(), 0.0);
}

// Moved as a rigid body by w it has the energy ½ (k_x w_x² + k_z w_z²) L, whatever its shape.
TEST(Foundation, OfAMovedBodyHasTheEnergyOfItsLength) {
  const BentShape bent;
  const StretchReference stretch = stretch_reference(bent.shape, 0.4, 0.9);
  const Vec2 w(0.3, -0.2);
  Vector u = Vector::Zero(6);
  u.segment<2>(0) = u.segment<2>(3) = w;
  const double per_length = 0.5 * (stiffness.x() * w.x() * w.x() + stiffness.y() * w.y() * w.y());
  EXPECT_NEAR(test::evaluated(BeamFoundation(stretch, stiffness), u).energy, per_length * stretch.length, 1e-14);
  for (const int order : {1, 2}) {
    const ExactBeamReference reference = bent_reference(order);
    Vector moved = Vector::Zero(3 * (order + 1));
    for (int a = 0; a <= order; ++a) moved.segment<2>(3 * a) = w;
    EXPECT_NEAR(test::evaluated(ExactFoundation(reference, stiffness), moved).energy,
                per_length * reference.arcs.back(), 1e-14);
  }
}

// With the law from 0 to its point (−0.5, −0.7), moved there: the force is 0.7 − (−0.5) 1.9 by length, and the law's
// energy by Hermite's cubic ∫ F du = ½ 0.5 0.7 + 0.5² m/12, m the weighted harmonic mean of the secants 1.4 and 4/3.
TEST(Foundation, OfABodyMovedAlongALawHasTheEnergyOfThat) {
  const BentShape bent;
  const StretchReference stretch = stretch_reference(bent.shape, 0.4, 0.9);
  Vector u = Vector::Zero(6);
  u[1] = u[4] = -0.5;
  const double m = 3.0 * 0.8 / ((2.0 * 0.3 + 0.5) / 1.4 + (0.3 + 2.0 * 0.5) / (4.0 / 3.0));
  const double per_length = 0.5 * 1.9 * 0.25 + 0.5 * 0.5 * 0.7 + 0.25 / 12.0 * m;
  const auto found = test::evaluated(BeamFoundation(stretch, bent_law()), u);
  EXPECT_NEAR(found.energy, per_length * stretch.length, 1e-14);
  EXPECT_NEAR(found.f[1] + found.f[4], -(0.5 * 1.9 + 0.7) * stretch.length, 1e-14);
}

// The ends of the stretch slide along the member while the beam stays where it is.
void expect_consistent_rates(const FoundationLaw& stiffness) {
  constexpr double step = 1e-6;
  test::Numbers numbers(92);
  const BentShape bent;
  const Vector q = numbers.vector(6);
  const auto force = [&](double S1, double S2) {
    const Vec2 first = bent.shape.at(S1).position;
    return StretchFoundation(stretch_reference(bent.shape, S1, S2), stiffness)
        .respond(q.head<2>() - first, q[2], q.segment<2>(3) - first, q[5])
        .force;
  };
  const Vec2 first = bent.shape.at(0.5).position;
  const auto here = StretchFoundation(stretch_reference(bent.shape, 0.5, 0.9), stiffness)
                        .respond(q.head<2>() - first, q[2], q.segment<2>(3) - first, q[5]);
  EXPECT_LE((here.stiffness - here.stiffness.transpose()).norm(), 1e-14);
  EXPECT_LE(((force(0.5 + step, 0.9) - force(0.5 - step, 0.9)) / (2.0 * step) - here.force_rate[0]).norm(), 1e-8);
  EXPECT_LE(((force(0.5, 0.9 + step) - force(0.5, 0.9 - step)) / (2.0 * step) - here.force_rate[1]).norm(), 1e-8);
}

TEST(StretchFoundation, RatesAreConsistent) { expect_consistent_rates(stiffness); }
TEST(StretchFoundation, RatesOfALawAreConsistent) { expect_consistent_rates(bent_law()); }

// Hetényi (1946): a beam with free ends under P in its middle goes down there by
//
//   P β/(2k) (cosh βL + cos βL + 2)/(sinh βL + sin βL),   β⁴ = k/(4 EI)
TEST(Foundation, CarriesABeamWithFreeEndsAsHetenyiHasIt) {
  const double EI = 0.02, L = 2.0, k = 3.0, P = 1e-7;
  const double beta = std::pow(k / (4.0 * EI), 0.25), a = beta * L;
  const double exact = P * beta / (2.0 * k) * (std::cosh(a) + std::cos(a) + 2.0) / (std::sinh(a) + std::sin(a));
  for (const test::BeamTheory& theory :
       {test::BeamTheory{.theory = Theory::euler_bernoulli}, test::BeamTheory{.theory = Theory::elastica, .order = 4},
        test::BeamTheory{.theory = Theory::elastica, .order = 6}}) {
    std::vector<double> found;
    for (const int elements : {4, 8, 16, 32}) found.push_back(middle_deflection(theory, EI, 0.0, L, k, P, elements));
    test::expect_convergence(found, {.exact = exact, .order = 4.0});
  }
  // A Reissner beam that hardly shears.
  EXPECT_NEAR(middle_deflection({.theory = Theory::reissner, .order = 2}, EI, 1e7, L, k, P, 64) / exact, 1.0, 1e-5);
}

}  // namespace arcwall::foundation_element_test
