#include <gtest/gtest.h>

#include "apps/cli/example_decks.hpp"
#include "apps/deck/reader.hpp"
#include "apps/study.hpp"
#include "tests/support/explore.hpp"

namespace arcwall::example_steps_test {

namespace {

test::Graph traced(const Study& study, double first, double greatest) {
  std::string reason;
  const auto start = study.start(reason);
  EXPECT_TRUE(start.has_value()) << reason;
  TraceOptions options = study.options();
  options.step.first *= first;
  options.step.max *= greatest;
  return test::explore(study.system(), options, study.explore(), start.value(), study.watched());
}

}  // namespace

// Steps of a quarter and of four times the deck's give the same branches, events, contacts and counts, λ to 1e-8; and
// none of these structures has a tangential approach.
TEST(ExampleDecks, FindTheSameEventsWithAnyStepSlow) {
  for (const ExampleDeck& example : example_decks()) {
    SCOPED_TRACE(std::string(example.name));
    const Study study(deck::read_deck_text(example.text, std::string(example.name)));
    const test::Graph expected = traced(study, 1.0, 1.0);
    for (const test::Branch& branch : expected.branches)
      for (const Event& event : test::events_of(branch)) EXPECT_FALSE(event.suspected);
    for (const double first : {0.25, 4.0})
      for (const double greatest : {1.0, first}) {
        SCOPED_TRACE("first step times " + std::to_string(first) + ", greatest times " + std::to_string(greatest));
        test::expect_same_graphs(traced(study, first, greatest), expected);
      }
  }
}

}  // namespace arcwall::example_steps_test
