#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dense.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Penalty and augmented contact against rigid contact, which has tests of its own: the beam on a flat foundation and
// the column in a channel of Selke & Kikuchi [kN, cm].
namespace arcwall::contact_laws_test {

namespace {

using test::trace;

test::Branch bent_to(double moment, const test::ContactModel& model) {
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values.push_back(test::stop_at_lambda(moment));
  const test::Branch branch = trace(model.system(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 5});
  return branch;
}

std::vector<double> loads(const test::Branch& branch) {
  std::vector<double> found;
  for (const Event& event : events_of(branch))
    if (event.kind == EventKind::contact_closes || event.kind == EventKind::contact_opens)
      found.push_back(event.state.lambda);
  return found;
}

test::Branch snapped(const ContactLaw& law) {
  const auto model = test::Channel{.elements = 20, .imperfection = test::snapping_imperfection(), .law = law}.model();
  TraceOptions options;
  options.step.first = 0.05;
  options.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(10.0)};
  const test::Branch branch = trace(model.system(), options);
  EXPECT_EQ(branch.end.reason, EndReason::stop);
  expect_branch_invariants(model.system(), branch, options, {.recount_every = 5});
  return branch;
}

constexpr auto penalty = ContactLaw::Method::penalty;
constexpr auto augmented = ContactLaw::Method::augmented;

}  // namespace

// A spring gives way by 1/stiffness, and all loads follow to first order: over four decades the distance from the rigid
// wall falls with the stiffness. The first contact is the same: no spring is pressed before.
TEST(PenaltyContact, EventLoadsTendToThoseOfRigidContactWithOrderOne) {
  const std::vector<double> rigid = loads(bent_to(3.0, test::foundation_beam(20)));
  ASSERT_GE(rigid.size(), 3U);
  std::vector<double> softness;
  std::vector<std::vector<double>> errors(rigid.size());
  for (const double stiffness : {1e6, 1e7, 1e8, 1e9, 1e10}) {
    SCOPED_TRACE(stiffness);
    const auto found = loads(bent_to(3.0, test::foundation_beam(20, {.method = penalty, .stiffness = stiffness})));
    ASSERT_EQ(found.size(), rigid.size());
    EXPECT_NEAR(found[0], rigid[0], 1e-11);
    softness.push_back(1.0 / stiffness);
    for (std::size_t i = 1; i < rigid.size(); ++i) errors[i].push_back(found[i] - rigid[i]);
  }
  for (std::size_t i = 1; i < rigid.size(); ++i)
    EXPECT_NEAR(test::observed_order(softness, errors[i]), 1.0, 0.05) << "event " << i;
}

TEST(AugmentedContact, HasTheEventsOfRigidContactWithSoftSprings) {
  const std::vector<double> rigid = loads(bent_to(3.0, test::foundation_beam(20)));
  for (const double stiffness : {1e2, 1e5}) {
    const auto found = loads(bent_to(3.0, test::foundation_beam(20, {.method = augmented, .stiffness = stiffness})));
    ASSERT_EQ(found.size(), rigid.size());
    for (std::size_t i = 0; i < rigid.size(); ++i) EXPECT_NEAR(found[i], rigid[i], 1e-10);
  }
}

// Contacts change some thirty times, the column snaps through and lands on the other wall.
TEST(AugmentedContact, SnapsThroughTheChannelLikeRigidContact) {
  const auto rigid = events_of(snapped({})), found = events_of(snapped({.method = augmented, .stiffness = 1e4}));
  ASSERT_EQ(found.size(), rigid.size());
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    EXPECT_EQ(found[i].kind, rigid[i].kind);
    EXPECT_EQ(found[i].guards, rigid[i].guards);
    EXPECT_NEAR(found[i].state.lambda, rigid[i].state.lambda, 1e-8);
  }
}

}  // namespace arcwall::contact_laws_test
