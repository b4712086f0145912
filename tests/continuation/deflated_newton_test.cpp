#include "continuation/equilibria/deflated_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/algebra/ldlt.hpp"
#include "tests/support/toys.hpp"

namespace arcwall::deflated_newton_test {
namespace {

using Contacts = DeflatedNewton::Contacts;

State at(double x) { return {.x = test::scalar(x), .lambda = 0.0, .active_set = {}}; }

// One unknown that a spring pushes, by λ, onto a wall at 1 from below.
test::LinearContactToy pushed_onto_a_wall() {
  test::LinearContactToy toy;
  toy.A = test::scalar_matrix(1.0);
  toy.f = test::scalar(1.0);
  toy.G = test::scalar_matrix(-1.0);
  toy.gap0 = test::scalar(1.0);
  return toy;
}

}  // namespace

// x³ − 3 x = 0 has the solutions 0 and ±√3.
TEST(DeflatedNewton, ArrivesAtEachSolutionOnce) {
  const test::SmoothToy toy = test::cusp(3.0);
  DeflatedNewton newton(toy, Contacts::follow, make_ldlt);
  struct Try {
    double from, to;
  };
  const std::vector<Try> tries{{0.2, 0.0}, {1.5, std::sqrt(3.0)}, {-1.5, -std::sqrt(3.0)}};
  for (const Try& one : tries) {
    const DeflatedResult result = newton.from(at(one.from));
    ASSERT_EQ(result.end, DeflatedEnd::arrived) << one.to;
    EXPECT_NEAR(result.state.x[0], one.to, 1e-12);
    EXPECT_FALSE(newton.is_known(result.state));
    newton.deflate(result.state.x);
    EXPECT_TRUE(newton.is_known(result.state));
  }
  for (const Try& one : tries) EXPECT_NE(newton.from(at(one.from)).end, DeflatedEnd::arrived) << one.to;
}

// Beside a known solution at x₀ the step of Newton's method, x₀ − x, becomes its opposite: (16.2) with s = 2.
TEST(DeflatedNewton, IsDrivenOffWhatIsKnown) {
  const test::SmoothToy toy = test::cusp(3.0);
  DeflatedNewton newton(toy, Contacts::follow, make_ldlt);
  newton.deflate(test::scalar(0.0));
  const DeflatedResult result = newton.from(at(1e-3));
  EXPECT_EQ(result.end, DeflatedEnd::not_found);
  EXPECT_GT(std::abs(result.state.x[0]), 0.05);
}

// At the solution itself the factor of the step is that of a shift, so that it would be accepted again.
TEST(DeflatedNewton, RefusesWhatIsKnown) {
  const test::SmoothToy toy = test::cusp(3.0);
  DeflatedNewton newton(toy, Contacts::follow, make_ldlt);
  newton.deflate(test::scalar(std::sqrt(3.0)));
  EXPECT_EQ(newton.from(at(std::sqrt(3.0))).end, DeflatedEnd::known);
  EXPECT_NE(newton.from(at(std::sqrt(3.0) + 1e-9)).end, DeflatedEnd::arrived);
}

// λ = 2 presses with 2 − 1 on the wall; a guess inside the wall is as good as one before it.
TEST(DeflatedNewton, ClosesAndOpensContacts) {
  const test::LinearContactToy toy = pushed_onto_a_wall();
  for (const double guess : {-0.5, 0.9, 1.7}) {
    DeflatedNewton newton(toy, Contacts::follow, make_ldlt);
    const DeflatedResult pressed =
        newton.from({.x = test::scalar(guess), .lambda = 2.0, .active_set = toy.open_active_set()});
    ASSERT_EQ(pressed.end, DeflatedEnd::arrived);
    ASSERT_EQ(pressed.state.active_set, ActiveSet{1});
    EXPECT_NEAR(pressed.state.x[0], 1.0, 1e-12);
    EXPECT_NEAR(pressed.state.x[1], 1.0, 1e-12);
    const DeflatedResult free =
        newton.from({.x = test::scalar(guess), .lambda = 0.5, .active_set = toy.open_active_set()});
    ASSERT_EQ(free.state.active_set, ActiveSet{0});
    EXPECT_NEAR(free.state.x[0], 0.5, 1e-12);
  }
}

// Contacts that are kept may pull: whoever asks for them looks at the forces.
TEST(DeflatedNewton, KeepsContacts) {
  const test::LinearContactToy toy = pushed_onto_a_wall();
  DeflatedNewton newton(toy, Contacts::keep, make_ldlt);
  State guess{.x = Vector::Zero(2), .lambda = 0.5, .active_set = ActiveSet{1}};
  guess.x[0] = 0.9;
  const DeflatedResult result = newton.from(guess);
  ASSERT_EQ(result.end, DeflatedEnd::arrived);
  EXPECT_EQ(result.state.active_set, ActiveSet{1});
  EXPECT_NEAR(result.state.x[1], -0.5, 1e-12);
}

TEST(DeflatedNewton, FindsWhatAGuessIsBeside) {
  const test::SmoothToy toy = test::cusp(3.0);
  DeflatedNewton newton(toy, Contacts::follow, make_ldlt);
  const auto beside = newton.beside(at(std::sqrt(3.0) + 1e-7));
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->x[0], std::sqrt(3.0), 1e-12);
  EXPECT_FALSE(newton.beside(at(std::sqrt(3.0) + 1e-3)));
}

}  // namespace arcwall::deflated_newton_test
