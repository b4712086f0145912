#include "continuation/stability.hpp"

#include <gtest/gtest.h>

#include "tests/support/toys.hpp"

namespace arcwall::stability_test {

namespace {

// Two unknowns with stiffness −1 and 2, the first held by a contact.
test::LinearContactToy held_unstable() {
  test::LinearContactToy toy;
  toy.A = Matrix{{-1.0, 0.0}, {0.0, 2.0}};
  toy.f = Vector::Ones(2);
  toy.G = Matrix{{1.0, 0.0}};
  toy.gap0 = Vector::Zero(1);
  return toy;
}

State with_force(double p) { return {.x = Vector{{0.0, 0.5, p}}, .lambda = 1.0, .active_set = {1}}; }

}  // namespace

TEST(Stability, AContactThatCarriesForceHolds) {
  const auto toy = held_unstable();
  FactorizedEquations shared(toy);
  StabilityCounter counter(toy, shared, 1e-12);
  const StabilityCount count = counter.count(with_force(0.3), std::nullopt);
  EXPECT_EQ(count.unstable, 0);
  EXPECT_EQ(count.stability, Stability::stable);
}

TEST(Stability, AContactWithoutForceHoldsNothingAndLeavesTheMatterOpen) {
  const auto toy = held_unstable();
  FactorizedEquations shared(toy);
  StabilityCounter counter(toy, shared, 1e-12);
  const StabilityCount count = counter.count(with_force(1e-13), std::nullopt);
  EXPECT_EQ(count.unstable, 1);
  EXPECT_EQ(count.stability, Stability::undecided);  // only motions off the wall are allowed
  EXPECT_EQ(strictly_active(toy, with_force(1e-13), 1e-12), ActiveSet{0});
  EXPECT_EQ(strictly_active(toy, with_force(0.3), 1e-12), ActiveSet{1});
}

TEST(Stability, WhatIsUnstableWithAllContactsHeldIsUnstable) {
  auto toy = held_unstable();
  toy.A(1, 1) = -2.0;
  FactorizedEquations shared(toy);
  StabilityCounter counter(toy, shared, 1e-12);
  const StabilityCount count = counter.count(with_force(0.0), std::nullopt);
  EXPECT_EQ(count.unstable, 2);
  EXPECT_EQ(count.stability, Stability::unstable);
}

// Two stiffnesses of 1 coupled so that the difference of their ends has stiffness k: far below 10⁻⁹ the sign is right.
TEST(Stability, CountsAreRightNextToSingularity) {
  for (const double k : {1e-9, 1e-12, 1e-14})
    for (const double sign : {1.0, -1.0}) {
      test::LinearContactToy toy;
      const double a = 0.5 * (1.0 + sign * k), b = 0.5 * (1.0 - sign * k);
      toy.A = Matrix{{a, b, 0.0}, {b, a, 0.0}, {0.0, 0.0, -3.0}};
      toy.f = Vector::Ones(3);
      toy.G = Matrix{{0.0, 0.0, 1.0}};
      toy.gap0 = Vector::Zero(1);
      FactorizedEquations shared(toy);
      StabilityCounter counter(toy, shared, 1e-12);
      const Index unstable = sign < 0.0 ? 1 : 0;
      EXPECT_EQ(counter.negative_on({.x = Vector::Zero(4), .lambda = 0.0, .active_set = {1}}), unstable) << sign * k;
      EXPECT_EQ(counter.negative_on({.x = Vector::Zero(3), .lambda = 0.0, .active_set = {0}}), unstable + 1)
          << sign * k;
    }
}

TEST(Stability, CountsBySharedEquationsOnTheirActiveSetAndByItsOwnElsewhere) {
  const auto toy = held_unstable();
  FactorizedEquations shared(toy);
  StabilityCounter counter(toy, shared, 1e-12);
  const State held = with_force(0.3), open = toy.with_active_set(held, {0});
  ASSERT_EQ(shared.set_point(held), FactorStatus::ok);
  EXPECT_EQ(counter.negative_on(open), 1);
  EXPECT_TRUE(shared.is_at(held));  // undisturbed
  const State other{.x = 2.0 * held.x, .lambda = 1.0, .active_set = {1}};
  EXPECT_EQ(counter.negative_on(other), 0);
  EXPECT_TRUE(shared.is_on(other.active_set));
  EXPECT_FALSE(shared.has_point());
}

TEST(Stability, ASingularStiffnessHasNoCount) {
  const test::SmoothToy toy = test::fold();
  FactorizedEquations shared(toy);
  StabilityCounter counter(toy, shared, 1e-12);
  EXPECT_FALSE(counter.count({.x = test::scalar(0.0)}, std::nullopt).unstable.has_value());
  EXPECT_EQ(counter.count({.x = test::scalar(-1.0), .lambda = -1.0}, std::nullopt).unstable, 1);
  EXPECT_EQ(counter.count({.x = test::scalar(1.0), .lambda = -1.0}, std::nullopt).unstable, 0);
}

}  // namespace arcwall::stability_test
