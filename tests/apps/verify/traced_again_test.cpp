#include "apps/verify/again.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/decks_with_events.hpp"

namespace arcwall::verify::traced_again_test {

namespace {

using test::example;
using test::TracedDeck;

}  // namespace

TEST(TracedAgain, RightRunsAgree) {
  for (const TracedDeck& traced : decks_with_events()) {
    SCOPED_TRACE(traced.record().title);
    const auto again = traced_again(traced.session());
    ASSERT_TRUE(again.has_value());
    EXPECT_LT(again->points()[1].arc, traced.record().points[1].arc);
    const Comparison comparison = compare(traced.record(), again->record(), step_discretisation(traced.model()));
    EXPECT_TRUE(comparison.differences.empty()) << comparison.differences.front();
    EXPECT_GE(comparison.same, 2);
    EXPECT_GT(comparison.worst_allowed, 0.0);
  }
}

// The bars' branch up to its snap, and what a search finds beyond: the inverted state and the way to it.
TEST(TracedAgain, BranchesThatWereFoundBeginWhereTheyBegan) {
  const TracedDeck traced(test::low_truss + R"toml([path]
step = 0.3
branches = "primary"
search = true
search_at = [1.0]
search_guesses = 20
stop = { lambda = [-2.0, 5.0], event = "limit-point" }
)toml");
  const auto found = [](const Record& record) {
    return std::count_if(record.branches.begin(), record.branches.end(),
                         [](const auto& branch) { return branch.found; });
  };
  ASSERT_GT(found(traced.record()), 0);
  const auto again = traced_again(traced.session());
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(found(again->record()), found(traced.record()));
  const Comparison right = compare(traced.record(), again->record(), step_discretisation(traced.model()));
  EXPECT_TRUE(right.differences.empty()) << right.differences.front();
  Record record = traced.record();
  const auto on_found = [&](const RecordEvent& event) {
    return event.kind == EventKind::limit_point && record.branches[static_cast<std::size_t>(event.branch)].found;
  };
  const auto turn = std::find_if(record.events.begin(), record.events.end(), on_found);
  ASSERT_NE(turn, record.events.end());
  turn->lambda += 1e-3;
  EXPECT_EQ(compare(record, again->record(), step_discretisation(traced.model())).differences.size(), 1U);
}

TEST(TracedAgain, AnEventInOneRunOnlyIsNamedWithItsPlace) {
  const TracedDeck traced(example("channel"));
  Record record = traced.record();
  const auto touch = std::find_if(record.events.begin(), record.events.end(),
                                  [](const RecordEvent& event) { return event.kind == EventKind::contact_closes; });
  ASSERT_NE(touch, record.events.end());
  const std::string place = fmt::format("λ = {:.10g}", touch->lambda);
  record.events.erase(touch);
  for (const bool stored_lacks_it : {true, false}) {
    const Comparison comparison =
        stored_lacks_it ? compare(record, traced.record(), 1e-6) : compare(traced.record(), record, 1e-6);
    ASSERT_EQ(comparison.differences.size(), 1u);
    const std::string& what = comparison.differences.front();
    EXPECT_TRUE(what.starts_with("contact-closes of ")) << what;
    EXPECT_NE(what.find(place), std::string::npos) << what;
    EXPECT_NE(what.find(stored_lacks_it ? "in the run with a quarter of the step only" : "in the stored run only"),
              std::string::npos)
        << what;
  }
}

TEST(TracedAgain, AnEventElsewhereAnotherEndAndAnotherContactAreSeen) {
  const TracedDeck traced(example("channel"));
  const auto differences = [&](const std::function<void(Record&)>& change) {
    Record record = traced.record();
    change(record);
    return compare(record, traced.record(), 1e-6).differences.size();
  };
  const double range = traced.record().branches[0].greatest_lambda - traced.record().branches[0].least_lambda;
  EXPECT_EQ(differences([&](Record& record) { record.events[1].lambda += 0.9e-6 * range; }), 0u);
  EXPECT_EQ(differences([&](Record& record) { record.events[1].lambda += 1.1e-6 * range; }), 1u);
  EXPECT_EQ(differences([&](Record& record) {
              record.events[1].lambda += 1.1e-6 * range;
              record.events[1].lambda_uncertainty = 1e-6 * range;
            }),
            0u)
      << "what is said to be uncertain";
  EXPECT_EQ(differences([](Record& record) { record.events.back().branch_end->reason = EndReason::min_step; }), 2u);
  const auto with_contact = [](const RecordEvent& event) { return !event.contacts.empty(); };
  EXPECT_EQ(differences([&](Record& record) {
              std::find_if(record.events.begin(), record.events.end(), with_contact)->contacts[0].label.wall = "other";
            }),
            2u);
  EXPECT_EQ(differences([](Record& record) { record.events.insert(record.events.begin() + 1, record.events[1]); }), 1u);
}

// Two contacts that close at one λ by symmetry come in the order that round-off gives.
TEST(TracedAgain, EventsAtOneLambdaHaveNoOrder) {
  const TracedDeck traced(example("channel"));
  Record one = traced.record();
  one.events.insert(one.events.begin() + 2, one.events[1]);
  Record other = one;
  one.events[1].contacts.front().label.wall = other.events[2].contacts.front().label.wall = "left";
  EXPECT_TRUE(compare(one, other, 1e-6).differences.empty());
  one.events[1].lambda -= 1e-3;
  one.events[2].lambda += 1e-3;
  EXPECT_FALSE(compare(one, other, 1e-6).differences.empty());
}

// Suspected events, and what follows where a limit ended a run, are told but prove nothing.
TEST(TracedAgain, WhatIsSuspectedOrCutOffIsReserved) {
  const TracedDeck traced(example("channel"));
  Record record = traced.record();
  record.events.insert(record.events.begin() + 1, RecordEvent{.kind = EventKind::limit_point, .unconfirmed = true});
  record.events.back().branch_end->reason = EndReason::max_points;
  const Comparison comparison = compare(record, traced.record(), 1e-6);
  EXPECT_TRUE(comparison.differences.empty()) << comparison.differences.front();
  ASSERT_EQ(comparison.reservations.size(), 2u);
  EXPECT_NE(comparison.reservations[0].find("unconfirmed"), std::string::npos);
  EXPECT_NE(comparison.reservations[1].find("stopped before"), std::string::npos);
}

}  // namespace arcwall::verify::traced_again_test
