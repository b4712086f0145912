#include "elements/spring_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/derivative_check.hpp"
#include "elements/kinked_springs.hpp"
#include "elements/member_point.hpp"
#include "elements/structure.hpp"
#include "tests/support/beam_theories.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::spring_law_test {

namespace {

const SpringLaw odd({-0.1, 0.0, 0.1}, {-2.0, 0.0, 2.0});
const SpringLaw uneven({-0.3, -0.1, 0.0, 0.2, 0.5, 0.6}, {-1.0, -0.9, 0.0, 0.7, 0.2, 0.2});

}  // namespace

TEST(SpringLaw, MeetsItsPointsAndIsConstantBeyond) {
  EXPECT_DOUBLE_EQ(uneven.at(0.2).force, 0.7);
  EXPECT_DOUBLE_EQ(uneven.at(-0.1).force, -0.9);
  EXPECT_EQ(uneven.at(0.0).force, 0.0);
  EXPECT_EQ(uneven.at(0.0).energy, 0.0);
  EXPECT_EQ(uneven.at(9.0).force, 0.2);
  EXPECT_EQ(uneven.at(-9.0).force, -1.0);
  EXPECT_EQ(uneven.at(9.0).stiffness, 0.0);
}

// Through three points on a line the slope in the middle is the line's and those at the ends 0: F = 2 (s + s² − s³)
// with s = u/0.1, by hand, and its integral.
TEST(SpringLaw, IsHermitesCubic) {
  for (const double u : {-0.09, -0.02, 0.03, 0.08}) {
    const double s = std::abs(u) / 0.1, by_hand = std::copysign(2.0 * (s + s * s - s * s * s), u);
    EXPECT_NEAR(odd.at(u).force, by_hand, 1e-14);
    EXPECT_NEAR(odd.at(u).energy, 0.2 * (s * s / 2.0 + s * s * s / 3.0 - s * s * s * s / 4.0), 1e-15);
  }
}

TEST(SpringLaw, DerivativesAreConsistentAndTheSlopeContinuous) {
  constexpr double step = 1e-6;
  for (const double u : {-0.5, -0.27, -0.1, -0.03, 0.0, 0.11, 0.2, 0.33, 0.5, 0.55, 0.7}) {
    const auto above = uneven.at(u + step), below = uneven.at(u - step), here = uneven.at(u);
    EXPECT_NEAR((above.energy - below.energy) / (2.0 * step), here.force, 1e-8) << u;
    EXPECT_NEAR((above.force - below.force) / (2.0 * step), here.stiffness, 1e-4) << u;
    EXPECT_NEAR(above.stiffness, below.stiffness, 1e-3) << u;
  }
}

// Monotone where the points are, with their extremes.
TEST(SpringLaw, DoesNotOvershoot) {
  double last = uneven.at(-0.3).force;
  for (double u = -0.3; u <= 0.2; u += 0.001) {
    const double force = uneven.at(u).force;
    EXPECT_GE(force, last - 1e-15);
    EXPECT_LE(force, 0.7 + 1e-15);
    last = force;
  }
}

// Springs to the ground and between degrees of freedom, one of which a support moves, are part of the structure's
// derivatives.
TEST(SpringLaw, BelongsToAStructure) {
  test::Numbers numbers(151);
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_joint({2.0, 0.3});
  for (Index m = 0; m < 2; ++m)
    builder.add_member(
        {.name = m == 0 ? "a" : "b",
         .from = m,
         .to = m + 1,
         .axis = straight_axis(m == 0 ? Vec2(0.0, 0.0) : Vec2(1.0, 0.0), m == 0 ? Vec2(1.0, 0.0) : Vec2(2.0, 0.3)),
         .section = test::section_of(20.0, 1.0),
         .elements = 2});
  for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
  builder.fix(builder.dof(2, Dof::z), {.proportional = 0.3});
  const auto law = std::make_shared<const SpringLaw>(uneven);
  builder.add_spring(std::nullopt, builder.dof(1, Dof::z), law);
  builder.add_spring(builder.dof(0, Dof::z), builder.dof(2, Dof::z), law);
  builder.add_spring(builder.dof(1, Dof::x), builder.dof(2, Dof::x), law);
  builder.add_spring(builder.dof(1, Dof::z), builder.dof(2, Dof::z), law);
  const auto structure = builder.build();
  const State state{.x = 0.05 * numbers.vector(structure->size({})), .lambda = 0.6};
  EXPECT_LE(check_derivatives(*structure, state).worst(), 1e-6);
  const Index held = structure->dof(2, Dof::z);
  const Row row = structure->reaction_gradient(state, held);
  constexpr double step = 1e-6;
  for (Index i = 0; i <= state.x.size(); ++i) {
    const auto at = [&](double by) {
      State moved = state;
      (i < state.x.size() ? moved.x[i] : moved.lambda) += by;
      return structure->reaction(moved, held);
    };
    EXPECT_NEAR((at(step) - at(-step)) / (2.0 * step), i < state.x.size() ? row.dx[i] : row.dlambda, 1e-4);
  }
}

// Straight pieces through the same points: forces and the areas below them by hand.
TEST(SpringLaw, MayBeStraightPieces) {
  const SpringLaw straight({-0.3, -0.1, 0.0, 0.2, 0.5, 0.6}, {-1.0, -0.9, 0.0, 0.7, 0.2, 0.2},
                           SpringLaw::Interpolation::linear);
  EXPECT_NEAR(straight.at(0.1).force, 0.35, 1e-15);
  EXPECT_NEAR(straight.at(0.1).energy, 0.0175, 1e-15);
  EXPECT_NEAR(straight.at(0.1).stiffness, 3.5, 1e-14);
  EXPECT_NEAR(straight.at(0.35).force, 0.45, 1e-15);
  EXPECT_NEAR(straight.at(0.35).energy, 0.07 + 0.15 * 0.575, 1e-15);
  EXPECT_NEAR(straight.at(-0.2).force, -0.95, 1e-15);
  EXPECT_NEAR(straight.at(-0.2).energy, 0.045 + 0.0925, 1e-15);
  EXPECT_EQ(straight.at(9.0).force, 0.2);
  EXPECT_NEAR(straight.at(1.0).energy, 0.07 + 0.135 + 0.1, 1e-15);
  EXPECT_EQ(straight.at(-9.0).stiffness, 0.0);
  const std::vector<double> stretches{-0.3, -0.1, 0.0, 0.2, 0.5}, jumps{0.5, 8.5, -5.5, -3.5 - 5.0 / 3.0, 5.0 / 3.0};
  const auto kinks = straight.kinks();  // none at 0.6: the law is constant before it, too
  ASSERT_EQ(kinks.size(), stretches.size());
  for (std::size_t i = 0; i < kinks.size(); ++i) {
    EXPECT_EQ(kinks[i].stretch, stretches[i]);
    EXPECT_NEAR(kinks[i].jump, jumps[i], 1e-13);
  }
  EXPECT_TRUE(uneven.kinks().empty());
  EXPECT_TRUE(SpringLaw({-0.1, 0.0, 0.3}, {-0.2, 0.0, 0.6}, SpringLaw::Interpolation::linear).kinks().size() == 2)
      << "points on a line have no kink but at the ends";
}

// On a piece a law goes on straight, wherever the stretch is: F, K and the energy belong together on every piece, and
// what kinks are among contacts holds.
TEST(KinkedSprings, AreSmoothOnEachPiece) {
  test::Numbers numbers(7);
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_joint({2.0, 0.3});
  for (Index m = 0; m < 2; ++m)
    builder.add_member(
        {.name = m == 0 ? "a" : "b",
         .from = m,
         .to = m + 1,
         .axis = straight_axis(m == 0 ? Vec2(0.0, 0.0) : Vec2(1.0, 0.0), m == 0 ? Vec2(1.0, 0.0) : Vec2(2.0, 0.3)),
         .section = test::section_of(20.0, 1.0),
         .elements = 2});
  for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(0, which));
  builder.fix(builder.dof(2, Dof::z), {.proportional = 0.3});
  const Index middle = builder.dof(1, Dof::z), end = builder.dof(2, Dof::z);
  const auto law = std::make_shared<const SpringLaw>(std::vector<double>{-0.05, -0.02, 0.0, 0.02, 0.05},
                                                     std::vector<double>{-0.5, -0.4, 0.0, 0.2, 0.1},
                                                     SpringLaw::Interpolation::linear);
  builder.add_spring(std::nullopt, middle, law);
  builder.add_spring(middle, end, law);
  const auto structure = builder.build();
  const auto motion = [&](Index dof) { return std::make_shared<DofObservable>(*structure, dof); };
  const KinkedSprings system(*structure, {{.law = law, .first = nullptr, .second = motion(middle)},
                                          {.law = law, .first = motion(middle), .second = motion(end)}});
  const ActiveSet open = system.open_active_set();
  ASSERT_EQ(open.kinks(), 10u);
  EXPECT_EQ(open.contacts(), 0u);
  for (int i = 0; i < 20; ++i) {
    State state{.x = 0.05 * numbers.vector(structure->size({})), .lambda = 0.2, .active_set = open};
    Vector F(state.x.size()), of_structure(state.x.size());
    const State by_stretch = system.with_kinks({.x = state.x, .lambda = state.lambda, .active_set = {}});
    EXPECT_GE(system.guards(by_stretch).minCoeff(), 0.0);
    system.residual(by_stretch, F);
    structure->residual(by_stretch, of_structure);
    EXPECT_EQ(F, of_structure);
    for (std::size_t j = 0; j < state.active_set.size(); ++j) state.active_set[j] = numbers() < 0.0 ? 1 : 0;
    EXPECT_LE(check_derivatives(system, state).worst(), 1e-6);
    for (Index j = 0; j < system.guard_count(open); ++j) {
      EXPECT_DOUBLE_EQ(system.guard(state, j), system.guards(state)[j]);
      // By the force of one more guard the equations of a piece become those of the next.
      ActiveSet off = state.active_set, on = state.active_set;
      off[static_cast<std::size_t>(j)] = 0;
      on[static_cast<std::size_t>(j)] = 1;
      const State without = system.with_active_set(state, off), with = system.with_active_set(state, on);
      Vector F_off(state.x.size()), F_on(state.x.size());
      system.residual(without, F_off);
      system.residual(with, F_on);
      EXPECT_LE((F_on - F_off + system.guard(with, j) * system.unit_force(without, j)).norm(), 1e-13);
      EXPECT_NEAR(system.guard(without, j), -system.enforcement(on, j).compliance * system.guard(with, j), 1e-15);
    }
  }
}

}  // namespace arcwall::spring_law_test
