#include "elements/pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/derivative_check.hpp"
#include "elements/axis.hpp"
#include "elements/structure.hpp"
#include "tests/elements/element_checks.hpp"
#include "tests/support/beam_theories.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::pressure_test {

namespace {

const Vec2 first(0.3, -0.8);

BeamReference curved() {
  constexpr double half = 0.4;
  const Vec2 chord(1.0, 0.7);
  return {.chord = chord, .length = chord.norm() * half / std::sin(half), .slope1 = half, .slope2 = -half};
}

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

// Its forces on the ends of the element alone.
Vector end_forces(const Element& element, const Vector& u) {
  Vector f = test::evaluated(element, u).f;
  element.complete_end_forces(u.data(), 0.0, f.data());
  return f;
}

// An arch from (−1, 0) over the crown (0, 1) in two members, pressed from outside by p; joints 0, 1 and 2.
StructureBuilder arch(const test::BeamTheory& theory, int elements, double EA = 1e4,
                      const Driven& pressure = {.proportional = 1.0}) {
  StructureBuilder builder;
  const Vec2 places[] = {{-1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}};
  for (const Vec2& place : places) builder.add_joint(place);
  const double half = std::sqrt(0.5);
  for (Index m = 0; m < 2; ++m) {
    const Vec2 from = places[m], to = places[m + 1];
    builder.add_member({.name = m == 0 ? "w" : "e",
                        .from = m,
                        .to = m + 1,
                        .axis = arc_axis(from, Vec2(m == 0 ? -half : half, half), to),
                        .theory = theory.theory,
                        .order = theory.order,
                        .section = test::section_of(EA, 1.0, EA),
                        .elements = elements});
    builder.add_pressure(m, pressure);
  }
  return builder;
}

}  // namespace

TEST(Pressure, DerivativesAreConsistent) {
  test::Numbers numbers(131);
  for (int i = 0; i < 5; ++i) test::expect_derivatives(BeamPressure(curved(), first), numbers.vector(6));
  for (const int order : {1, 2})
    for (const int unknowns : {3, 5})
      test::expect_derivatives(ExactPressure(bent_reference(order), first, unknowns),
                               numbers.vector(unknowns * (order + 1)));
}

TEST(Pressure, DoesNoWorkAtRest) {
  EXPECT_EQ(test::evaluated(BeamPressure(curved(), first), Vector::Zero(6)).energy, 0.0);
  for (const int order : {1, 2})
    EXPECT_EQ(test::evaluated(ExactPressure(bent_reference(order), first), Vector::Zero(3 * (order + 1))).energy, 0.0);
}

// On a closed or open line pressure adds up to p across the chord, and its moment about the middle of the chord
// vanishes for a symmetric shape: it acts towards the right, and its gradient does not depend on the origin.
TEST(Pressure, AddsUpToThatOnTheChord) {
  test::Numbers numbers(132);
  const Vector u = numbers.vector(6);
  const BeamReference reference = curved();
  const Vec2 chord = reference.chord + u.segment<2>(3) - u.segment<2>(0);
  const Vector f = end_forces(BeamPressure(reference, first), u);
  EXPECT_LE((f.segment<2>(0) + f.segment<2>(3) - perp(chord)).norm(), 1e-14);
  EXPECT_LE((f - end_forces(BeamPressure(reference, Vec2(70.0, -90.0)), u)).norm(), 1e-12);
  // The cubic from end to end has the moment of the pressure about its first end: ∫ r × dr⊥ = ½ |c|².
  EXPECT_NEAR(f[2] + f[5] + cross(chord, f.segment<2>(3)), 0.5 * chord.squaredNorm(), 1e-14);
  for (const int order : {1, 2}) {
    const Vector v = numbers.vector(3 * (order + 1));
    const ExactBeamReference exact = bent_reference(order);
    const Vec2 between = exact.nodes.back() + v.segment<2>(3 * order) - v.head<2>();
    const Vector g = end_forces(ExactPressure(exact, first), v);
    Vec2 sum = Vec2::Zero();
    for (Index a = 0; a <= order; ++a) sum += g.segment<2>(3 * a);
    EXPECT_LE((sum - perp(between)).norm(), 1e-14);
  }
}

// The textbook's equivalent forces of a load −p.
TEST(Pressure, OnAStraightBeamAtRestIsTheLoadAcross) {
  constexpr double h = 0.8;
  const Vector f =
      end_forces(BeamPressure({.chord = {h, 0.0}, .length = h, .slope1 = 0.0, .slope2 = 0.0}, first), Vector::Zero(6));
  EXPECT_LE((f - Vector{{0.0, h / 2.0, h * h / 12.0, 0.0, h / 2.0, -h * h / 12.0}}).norm(), 1e-14);
}

// The area under a circular segment, ½ R² (2γ − sin 2γ) beside its chord, to the fourth order.
TEST(Pressure, AreasAreOfTheFourthOrder) {
  std::vector<double> errors;
  for (const double half : {0.2, 0.1}) {
    const double chord = 2.0 * std::sin(half);
    const double V = pressure_on_stretch({0.0, 0.0}, half, {chord, 0.0}, -half).energy;
    errors.push_back(V / (0.5 * (2.0 * half - std::sin(2.0 * half))) - 1.0);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.2);  // of an area that is itself of the third order
}

// Gradient, stiffness and the reactions of structures whose pressed members end at joints that are held in both
// directions or in one, which may move.
TEST(Pressure, HasAPotentialWhereItsEndsAreHeldInOneDirection) {
  test::Numbers numbers(133);
  const test::BeamTheory theories[] = {{.theory = Theory::euler_bernoulli},
                                       {.theory = Theory::elastica, .order = 6},
                                       {.theory = Theory::reissner, .order = 2}};
  for (const test::BeamTheory& theory : theories)
    for (const bool x_is_free : {true, false}) {
      StructureBuilder builder = arch(theory, 2, 20.0);
      builder.fix(builder.dof(0, Dof::x), {.constant = 0.1, .proportional = 0.3});
      builder.fix(builder.dof(0, Dof::z));
      EXPECT_EQ(builder.open_pressed_joint(), std::optional<Index>(2));
      builder.fix(builder.dof(2, x_is_free ? Dof::z : Dof::x), {.constant = 0.2, .proportional = -0.4});
      EXPECT_FALSE(builder.open_pressed_joint().has_value());
      const auto structure = builder.build();
      const State state{.x = 0.05 * numbers.vector(structure->size({})), .lambda = 0.7};
      EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-8);
      for (const Dof which : {Dof::x, Dof::z}) {
        const Index dof = structure->dof(2, which);
        if (structure->unknown(dof)) continue;
        const Row row = structure->reaction_gradient(state, dof);
        constexpr double step = 1e-5;
        for (Index i = 0; i <= state.x.size(); ++i) {
          const auto at = [&](double by) {
            State moved = state;
            (i < state.x.size() ? moved.x[i] : moved.lambda) += by;
            return structure->reaction(moved, dof);
          };
          const double found = i < state.x.size() ? row.dx[i] : row.dlambda;
          EXPECT_NEAR((at(step) - at(-step)) / (2.0 * step), found, 1e-6 * (1.0 + std::abs(found)));
        }
      }
    }
}

// The energy grows by the work that moved supports do, whichever way the members run.
TEST(Pressure, EnergyGrowsByTheWorkOfMovedSupports) {
  test::Numbers numbers(134);
  const test::BeamTheory theories[] = {{.theory = Theory::euler_bernoulli}, {.theory = Theory::reissner, .order = 2}};
  for (const test::BeamTheory& theory : theories) {
    StructureBuilder builder = arch(theory, 2, 20.0, {.constant = 1.5});
    builder.fix(builder.dof(0, Dof::x), {.proportional = 0.3});
    builder.fix(builder.dof(0, Dof::z), {.constant = 0.1});
    builder.fix(builder.dof(2, Dof::x), {.constant = 0.2, .proportional = -0.4});
    builder.fix(builder.dof(2, Dof::z), {.constant = -0.3, .proportional = 0.25});
    const auto structure = builder.build();
    const State state{.x = 0.05 * numbers.vector(structure->size({})), .lambda = 0.7};
    double power = 0.0;
    structure->nodal_terms().for_each_moved_support(
        [&](Index dof, double rate) { power += structure->reaction(state, dof) * rate; });
    constexpr double step = 1e-4;
    const auto energy = [&](double by) {
      State moved = state;
      moved.lambda += by;
      return structure->energy(moved);
    };
    EXPECT_NEAR((energy(step) - energy(-step)) / (2.0 * step), power, 1e-7 * (1.0 + std::abs(power)));
  }
}

// In equilibrium the supports bear p across the line between them, whatever the arch does and wherever the origin is.
TEST(Pressure, IsBorneByTheSupports) {
  for (const bool x_is_free : {true, false}) {
    StructureBuilder builder = arch({.theory = Theory::elastica, .order = 6}, 4);
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
    builder.fix(builder.dof(2, Dof::z));
    if (!x_is_free) builder.fix(builder.dof(2, Dof::x));
    const auto structure = builder.build();
    const double p = x_is_free ? 0.2 : 1.0;
    const State state = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, p, 4);
    const auto reaction = [&](Index joint, Dof which) {
      return structure->reaction(state, structure->dof(joint, which));
    };
    const double width = (structure->current(state, 2) - structure->current(state, 0)).x();
    EXPECT_NEAR(reaction(0, Dof::x) + reaction(2, Dof::x), 0.0, 1e-9);
    EXPECT_NEAR(reaction(0, Dof::z) + reaction(2, Dof::z), p * width, 1e-9);
    EXPECT_NEAR(reaction(0, Dof::z), 0.5 * p * width, 1e-9);
  }
}

}  // namespace arcwall::pressure_test
