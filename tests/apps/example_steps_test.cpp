#include <gtest/gtest.h>

#include "apps/cli/example_decks.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/support/explore.hpp"

namespace arcwall::example_steps_test {

namespace {

test::Graph traced(const Model& model, double first, double greatest) {
  std::string reason;
  const auto start = model.start(reason);
  EXPECT_TRUE(start.has_value()) << reason;
  TraceOptions options = model.options();
  options.step.first *= first;
  options.step.max *= greatest;
  return test::explore(model.system(), options, model.explore(), start.value(), model.watched());
}

}  // namespace

// Steps of a quarter and of four times the deck's give the same branches, events, contacts and counts, λ to 1e-8; and
// none of these structures has a tangential approach.
TEST(ExampleDecks, FindTheSameEventsWithAnyStepSlow) {
  for (const ExampleDeck& example : example_decks()) {
    SCOPED_TRACE(std::string(example.name));
    const Model model(deck::read_deck_text(example.text, std::string(example.name)));
    const test::Graph expected = traced(model, 1.0, 1.0);
    for (const test::Branch& branch : expected.branches)
      for (const Event& event : test::events_of(branch)) EXPECT_FALSE(event.unconfirmed);
    for (const double first : {0.25, 4.0})
      for (const double greatest : {1.0, first}) {
        SCOPED_TRACE("first step times " + std::to_string(first) + ", greatest times " + std::to_string(greatest));
        test::expect_same_graphs(traced(model, first, greatest), expected);
      }
  }
}

}  // namespace arcwall::example_steps_test
