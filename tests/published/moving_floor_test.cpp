#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/branch.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/sliding_models.hpp"

// A beam of length L on two supports, one of which slides, carries λ q along its length while a level floor rises below
// it by λ v from the depth d. By the linear theory of beams (Timoshenko, Strength of Materials) the middle, which alone
// would sag by 5 λ q L⁴/384 EI, touches the floor and is held by the force
//
//     R = 48 EI/L³ (5 λ q L⁴/384 EI − (d − λ v)).
//
// Where λ q L⁴/384 EI = d − λ v the moment in the middle vanishes. From there on the beam lies on the floor between its
// two outer parts, which have the length a and rest on the floor's edges with the force λ q a/2:
//
//     a⁴ = 24 EI (d − λ v)/(λ q).
//
// Slopes are below 2·10⁻⁴, whose squares the linear theory leaves out: 4·10⁻⁸ of the results.
namespace arcwall::moving_floor_test {

namespace {

constexpr double L = 2.0, EI = 1.0, EA = 1e4, depth = 1e-4, rise = 0.2 * depth;
constexpr double q = 384.0 * EI / 5.0 * depth / (L * L * L * L);  // sags by the depth at λ = 1
constexpr double tolerance = 1e-6;

double sag(double lambda) { return 5.0 * lambda * q * L * L * L * L / (384.0 * EI); }
double gap_at_rest(double lambda) { return depth - lambda * rise; }
double reaction(double lambda) { return 48.0 * EI / (L * L * L) * (sag(lambda) - gap_at_rest(lambda)); }

constexpr double touches = depth / (depth + rise);          // 5 λ q L⁴/384 EI = d − λ v
constexpr double lies_down = depth / (depth / 5.0 + rise);  // λ q L⁴/384 EI = d − λ v

StructureBuilder loaded_beam(Theory theory, int elements) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(L, 0.0);
  builder.add_joint(a);
  builder.add_joint(b);
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis(a, b),
                      .theory = theory,
                      .order = 4,
                      .section = {.E = 1.0, .A = EA, .I = EI, .height = 0.0},
                      .elements = elements});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.dof(1, Dof::z));
  builder.add_distributed_load(0, {0.0, -q}, LoadKind::proportional);
  return builder;
}

std::vector<test::TestWall> rising_floor() {
  return {{.name = "floor",
           .side = Side::below,
           .profile = flat_profile(-depth),
           .on_axis = true,
           .motion = {.way = {0.0, rise}}}};
}

TraceOptions up_to(double lambda) {
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values.push_back(test::stop_at_lambda(lambda));
  return options;
}

}  // namespace

TEST(MovingFloor, HoldsTheNodeThatItMeetsAsLinearTheorySays) {
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    SCOPED_TRACE(static_cast<int>(theory));
    const test::ContactModel model(loaded_beam(theory, 16).build(), rising_floor(), 0.05);
    const TraceOptions options = up_to(1.5);
    const test::Branch branch = test::trace(model.system(), options);
    const auto closes = events_of(branch, EventKind::contact_closes);
    ASSERT_EQ(closes.size(), 1U);
    EXPECT_NEAR(closes[0].state.lambda, touches, tolerance);
    EXPECT_EQ(model.system().contact(closes[0].state, closes[0].guards[0]).label.fraction, 0.5);
    const auto contacts = model.system().closed_contacts(branch.last().state);
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_NEAR(contacts[0].force, reaction(1.5), tolerance * reaction(1.5));
    EXPECT_NEAR(contacts[0].place.y(), -gap_at_rest(1.5), 1e-12);
    EXPECT_LE((contacts[0].force_vector - Vec2(0.0, contacts[0].force)).norm(), 1e-15);
    expect_branch_invariants(model.system(), branch, options, {.recount_every = 5});
  }
}

TEST(MovingFloor, BearsTheBeamOverALengthAsLinearTheorySays) {
  for (const Theory theory : {Theory::euler_bernoulli, Theory::elastica}) {
    SCOPED_TRACE(static_cast<int>(theory));
    const test::SlidingModel model(loaded_beam(theory, 40), rising_floor(), 0.05);
    const TraceOptions options = up_to(4.0);
    const auto branches = test::follow(model.system(), model.system().rest(), options);
    const auto events = test::events_of(branches);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, EventKind::contact_closes);
    EXPECT_NEAR(events[0].state.lambda, touches, tolerance);
    EXPECT_EQ(events[1].kind, EventKind::contact_spreads);
    EXPECT_NEAR(events[1].state.lambda, lies_down, tolerance * lies_down);

    const State& last = branches.back().arcs.back().to.state;
    const double a = std::pow(24.0 * EI * gap_at_rest(4.0) / (4.0 * q), 0.25);
    const auto ends = model.system().closed_contacts(last);
    ASSERT_EQ(ends.size(), 2U);
    EXPECT_NEAR(ends[0].label.fraction * L, a, 1e-4);
    EXPECT_NEAR(ends[1].label.fraction * L, L - a, 1e-4);
    for (const ContactPoint& end : ends) EXPECT_NEAR(end.place.y(), -gap_at_rest(4.0), 1e-12);
    double pressed = 0.0;
    for (const ContactPoint& node : model.system().pressed_nodes(last)) pressed += node.force;
    EXPECT_NEAR(ends[0].force + ends[1].force + pressed, 4.0 * q * (L - a), 1e-5 * q);
    for (const test::ExploredBranch& branch : branches)
      test::expect_sliding_invariants(model.system(), branch.arcs, options, branch.lambda_scale, {.recount_every = 3});
  }
}

}  // namespace arcwall::moving_floor_test
