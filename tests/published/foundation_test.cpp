#include <gtest/gtest.h>

#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Selke & Kikuchi's first example [kN, cm].
namespace arcwall::foundation_test {

using test::trace;

// Before contact the axis is a circular arc, w = −(1 − cos k)/k with k = M/EI over the half length 1: the middle is
// 0.08 down at M = 0.448961073442, given to 12 digits. Elements bend to circles up to α⁶ of their chords, α = k h/2 =
// 0.002 at 80 elements: far below.
TEST(Foundation, FirstContactIsThatOfACircularArc) {
  const test::ContactModel model = test::foundation_beam(80);
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values.push_back(test::stop_at_lambda(1.0));
  const test::Branch branch = trace(model.system(), options);
  const auto closes = events_of(branch, EventKind::contact_closes);
  ASSERT_FALSE(closes.empty());
  EXPECT_NEAR(closes[0].state.lambda, 0.448961073442, 2e-11);
  ASSERT_EQ(closes[0].guards.size(), 1U);
  EXPECT_EQ(model.system().candidate(closes[0].guards[0]).label().fraction, 0.5);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 5});
}

// Up to M = 1.3431 the beam touches at its middle only; the force there at M = 1 is 1.66364268 by the extensible
// elastica.
TEST(Foundation, TheForceAtTheMiddleIsThatOfTheElasticaWhileOnePointTouches) {
  const test::ContactModel model = test::foundation_beam(80);
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values.push_back(test::stop_at_lambda(1.0));
  const test::Branch branch = trace(model.system(), options);
  const State& state = branch.last().state;
  double force = 0.0;
  for (Index j = 0; j < model.system().contact_count(); ++j) force += model.system().force(state, j);
  EXPECT_EQ(std::count(state.active_set.begin(), state.active_set.end(), 1), 1);
  // The face touches at the middle, where the section is upright: the same equilibrium as on the axis.
  EXPECT_NEAR(force, 1.66364268, 1e-7);
}

}  // namespace arcwall::foundation_test
