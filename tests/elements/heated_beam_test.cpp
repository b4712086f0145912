#include "elements/heated_beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/derivative_check.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/sliding_models.hpp"

namespace arcwall::heated_beam_test {

namespace {

struct BeamKind {
  Theory theory;
  int order;
};
constexpr BeamKind beam_kinds[] = {{Theory::euler_bernoulli, 2},
                                   {Theory::elastica, 4},
                                   {Theory::elastica, 6},
                                   {Theory::reissner, 1},
                                   {Theory::reissner, 2}};

std::string name_of(const BeamKind& kind) {
  return "theory " + std::to_string(static_cast<int>(kind.theory)) + ", order " + std::to_string(kind.order);
}

// A cantilever along an arc with a wave, or straight, clamped at joint 0.
StructureBuilder cantilever(const BeamKind& kind, bool bent, int elements) {
  StructureBuilder builder;
  const Vec2 from(0.0, 0.0), to(2.0, 0.0);
  builder.add_joint(from);
  builder.add_joint(to);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = bent ? arc_axis(from, {1.0, 0.3}, to) : straight_axis(from, to),
                      .imperfection = bent ? std::vector<SineDeviation>{{.amplitude = 0.05, .waves = 2}}
                                           : std::vector<SineDeviation>{},
                      .theory = kind.theory,
                      .order = kind.order,
                      .section = test::section_of(50.0, 0.7, 20.0),
                      .elements = elements});
  for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
  builder.fix(builder.shared_rotation(0).value());
  return builder;
}

constexpr ThermalStrain warm{.strain = {.constant = 0.02, .proportional = 0.1},
                             .curvature = {.constant = -0.1, .proportional = 0.4}};

}  // namespace

TEST(HeatedBeam, DerivativesAreConsistent) {
  test::Numbers numbers(95);
  for (const BeamKind& kind : beam_kinds)
    for (const bool bent : {false, true}) {
      SCOPED_TRACE(name_of(kind));
      StructureBuilder builder = cantilever(kind, bent, 4);
      builder.add_thermal_strain(0, warm);
      builder.fix(builder.dof(1, Dof::z), {.proportional = 0.2});
      builder.add_load(builder.dof(1, Dof::x), 0.3, LoadKind::proportional);
      const auto structure = builder.build();
      const State state{.x = 0.1 * numbers.vector(structure->size({})), .lambda = 0.6};
      EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-8);
      const ReactionObservable reaction(*structure, structure->dof(1, Dof::z));
      EXPECT_LE(check_gradient(reaction, state), 1e-8);
    }
}

// Nothing holds it: without any force it is 1 + e times as long and lies on a circle of the curvature κ by stress-free
// length, so that its tip is at (1 + e)/κ (sin κL, 1 − cos κL). The elastica's elements have circles exactly, the
// others to their order.
TEST(HeatedBeam, BendsFreelyToACircleSlow) {
  const double e = 0.1, kappa = 0.4, L = 2.0;
  const Vec2 tip = (1.0 + e) / kappa * Vec2(std::sin(kappa * L), 1.0 - std::cos(kappa * L));
  for (const BeamKind& kind : beam_kinds) {
    SCOPED_TRACE(name_of(kind));
    StructureBuilder free = cantilever(kind, false, kind.theory == Theory::reissner ? 64 : 16);
    free.add_thermal_strain(0, {.strain = {.proportional = e}, .curvature = {.proportional = kappa}});
    const auto structure = free.build();
    const State hot = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 60);
    const double allowed = kind.theory == Theory::reissner ? (kind.order == 1 ? 1e-3 : 1e-7) : 1e-10;
    EXPECT_LE((structure->current(hot, 1) - tip).norm(), allowed);
    EXPECT_NEAR(structure->value(hot, structure->members()[0].rotations.back().value()), kappa * L, 1e-10);
    EXPECT_NEAR(structure->reaction(hot, structure->dof(0, Dof::x)), 0.0, 1e-9);
    EXPECT_NEAR(structure->reaction(hot, structure->members()[0].rotations.front().value()), 0.0, 1e-9);
  }
}

// Held at both ends it carries −EA e, a truss EA (ε − e) by its measure of strain.
TEST(HeatedBeam, PressesAgainstFixedEnds) {
  for (const BeamKind& kind : beam_kinds) {
    SCOPED_TRACE(name_of(kind));
    StructureBuilder builder = cantilever(kind, false, 4);
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(1, which));
    builder.add_thermal_strain(0, {.strain = {.proportional = 1e-3}});
    const auto structure = builder.build();
    const State hot = test::solved_at(*structure, {.x = Vector::Zero(structure->size({}))}, 1.0, 1);
    EXPECT_NEAR(structure->reaction(hot, structure->dof(1, Dof::x)), -0.05, 1e-12);
  }
}

TEST(HeatedTruss, HasItsPartOfEveryDerivative) {
  test::Numbers numbers(96);
  for (const TrussStrain strain : {TrussStrain::green, TrussStrain::engineering, TrussStrain::log}) {
    StructureBuilder builder;
    const Vec2 at[] = {{0.0, 0.0}, {1.0, 0.5}, {2.0, 0.0}};
    for (const Vec2& position : at) builder.add_joint(position);
    for (int i = 0; i < 2; ++i)
      builder.add_member({.name = "bar",
                          .from = i,
                          .to = i + 1,
                          .axis = straight_axis(at[i], at[i + 1]),
                          .theory = Theory::truss,
                          .strain = strain,
                          .section = {.E = 5.0, .A = 2.0}});
    for (const Index joint : {0, 2})
      for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(joint, which));
    builder.add_thermal_strain(0, {.strain = warm.strain});
    const auto structure = builder.build();
    const State state{.x = 0.1 * numbers.vector(structure->size({})), .lambda = 0.3};
    EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-9);
  }
}

// Both meshes give one equilibrium.
TEST(HeatedBeam, IsTheSameWhereTheMeshSlides) {
  for (const BeamKind& kind : {beam_kinds[0], beam_kinds[1], beam_kinds[2]}) {
    SCOPED_TRACE(name_of(kind));
    StructureBuilder builder = cantilever(kind, true, 8);
    builder.fix(builder.dof(1, Dof::z), {.proportional = 0.1});
    builder.add_thermal_strain(0, warm);
    builder.add_load(builder.dof(1, Dof::x), 0.1, LoadKind::proportional);
    const auto fixed = builder.build();
    const test::SlidingModel model(builder, {}, 0.1);
    const State tied = test::solved_at(*fixed, {.x = Vector::Zero(fixed->size({}))}, 1.0, 40);
    const State slid = test::solved_at(model.system(), model.system().rest(), 1.0, 40);
    EXPECT_NEAR(model.joint(1, Dof::x)->value(slid), fixed->value(tied, fixed->dof(1, Dof::x)), 1e-9);
    EXPECT_NEAR(model.system().energy(slid), fixed->energy(tied), 1e-9);
    const JointObservable reaction(model.structure(), fixed->dof(1, Dof::z), JointObservable::What::reaction);
    EXPECT_NEAR(reaction.value(slid), fixed->reaction(tied, fixed->dof(1, Dof::z)), 1e-9);
    EXPECT_LE(check_gradient(reaction, slid), 1e-7);
  }
}

TEST(HeatedBeam, ConstantTemperaturesAreAppliedByTheRamp) {
  StructureBuilder builder = cantilever(beam_kinds[1], true, 4);
  builder.add_thermal_strain(0, warm);
  const auto whole = builder.build(), ramp = builder.build(true);
  const Vector x = 0.1 * test::Numbers(97).vector(whole->size({}));
  Vector F(x.size()), G(x.size());
  whole->residual({.x = x, .lambda = 0.0}, F);
  ramp->residual({.x = x, .lambda = 1.0}, G);
  EXPECT_LE((F - G).norm(), 1e-12 * F.norm());
}

}  // namespace arcwall::heated_beam_test
