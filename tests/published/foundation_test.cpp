#include <gtest/gtest.h>

#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Selke & Kikuchi's first example [kN, cm]: a beam of length 2 and square section 0.2 (E = 21000, EI = 2.8), 0.08 above
// a flat foundation, bent down by end moments λ; its right end slides.
namespace arcwall {

namespace {

using test::trace;

test::ContactModel bent_beam(int elements) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.0);
  builder.add_joint(a);
  builder.add_joint(b);
  constexpr double h = 0.2;
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(a, b),
                      .section = {.E = 21000.0, .A = h * h, .I = h * h * h * h / 12.0, .height = h},
                      .elements = elements});
  builder.fix(builder.freedom(0, Freedom::x));
  builder.fix(builder.freedom(0, Freedom::z));
  builder.fix(builder.freedom(1, Freedom::z));
  builder.add_load(builder.shared_rotation(0).value(), -1.0, LoadKind::proportional);
  builder.add_load(builder.shared_rotation(1).value(), 1.0, LoadKind::proportional);
  return {builder.build(), {{.name = "foundation", .side = Side::below, .profile = flat_profile(-0.18)}}, 0.05};
}

}  // namespace

// Before contact the axis is a circular arc, w = −(1 − cos k)/k with k = M/EI over the half length 1: the middle is
// 0.08 down at M = 0.448961073442, given to 12 digits. Elements bend to circles up to α⁶ of their chords, α = k h/2 =
// 0.002 at 80 elements: far below.
TEST(Foundation, FirstContactIsThatOfACircularArc) {
  const test::ContactModel model = bent_beam(80);
  TraceOptions options;
  options.step.first = 0.05;
  options.landmarks.push_back(test::stop_at_lambda(1.0));
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
  const test::ContactModel model = bent_beam(80);
  TraceOptions options;
  options.step.first = 0.05;
  options.landmarks.push_back(test::stop_at_lambda(1.0));
  const test::Branch branch = trace(model.system(), options);
  const State& state = branch.last().state;
  double force = 0.0;
  for (Index j = 0; j < model.system().contact_count(); ++j) force += model.system().force(state, j);
  EXPECT_EQ(std::count(state.piece.begin(), state.piece.end(), 1), 1);
  // The face touches at the middle, where the section is upright: the same equilibrium as on the axis.
  EXPECT_NEAR(force, 1.66364268, 1e-7);
}

}  // namespace arcwall
