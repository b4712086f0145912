// What events are called, against the contacts and the λ of the points on both sides of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "answers/branch_map.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::event_kinds_test {

namespace {

using test::TracedDeck;

struct Contacts {
  std::ptrdiff_t all = 0, zones = 0;
};

// Of a pattern as `upper lower= upper`.
Contacts contacts_of(const std::string& pattern) {
  Contacts contacts{.all = pattern.empty() ? 0 : 1 + std::count(pattern.begin(), pattern.end(), ' '),
                    .zones = std::count(pattern.begin(), pattern.end(), '=')};
  return contacts;
}

std::string_view deck(const std::string& name) {
  for (const auto& examples : {example_decks(), example_devices()})
    for (const ExampleDeck& example : examples)
      if (example.name == name) return example.text;
  ADD_FAILURE() << "no example is called " << name;
  return {};
}

// How many changes between points, zones and separate contacts there are that are one event and not several at a place.
int checked_changes(const TracedDeck& traced) {
  const BranchMap map = branch_map_of(traced.model(), traced.record());
  int checked = 0;
  for (const BranchMapEdge& edge : map.edges) {
    if (edge.events.size() != 1 || !edge.to) continue;
    const Contacts before = contacts_of(map.segments[edge.from].contact_pattern);
    const Contacts after = contacts_of(map.segments[*edge.to].contact_pattern);
    SCOPED_TRACE(edge.kind + " at λ = " + std::to_string(edge.lambda) + ": " + map.segments[edge.from].contact_pattern +
                 " → " + map.segments[*edge.to].contact_pattern);
    const auto expect = [&](bool more, bool fewer, bool zones_grow, bool zones_shrink) {
      EXPECT_EQ(after.all > before.all, more);
      EXPECT_EQ(after.all < before.all, fewer);
      EXPECT_TRUE(after.zones > before.zones || !zones_grow);
      EXPECT_TRUE(after.zones < before.zones || !zones_shrink);
      ++checked;
    };
    if (edge.kind == to_text(EventKind::contact_spreads)) expect(false, false, true, false);
    if (edge.kind == to_text(EventKind::contact_splits)) expect(true, false, false, false);
    if (edge.kind == to_text(EventKind::contact_shrinks)) expect(false, false, false, true);
    if (edge.kind == to_text(EventKind::contacts_merge)) expect(false, true, false, false);
  }
  return checked;
}

}  // namespace

// The column's contact splits, and its middle lifts off the wall.
TEST(EventKinds, AContactThatSplitsDoesNotSpread) {
  const TracedDeck traced(test::example("channel"));
  const RecordEvent& splits = test::event_of(traced, EventKind::contact_splits);
  EXPECT_TRUE(test::events_of(traced, EventKind::contact_spreads).empty());
  EXPECT_NEAR(splits.lambda, 1.695015, 1e-5);
  const auto& points = traced.record().points;
  const auto behind = static_cast<std::size_t>(splits.step) + 2;
  ASSERT_EQ(points[behind].forces.size(), 2U);
  EXPECT_NEAR(points[behind].forces[0].force, points[behind].forces[1].force, 1e-9);
  EXPECT_LT(points[behind + 2].monitors[0], 0.15 - 1e-7);  // off the wall at 0.15
}

// Each beside its pattern of contacts on both sides: a beam wraps a floor, a strip a cylinder, a rod bends in a bore.
TEST(EventKinds, SuitTheContactsOnBothSides) {
  int checked = 0;
  for (const char* example : {"channel", "foundation", "cylinder", "ring", "bow", "guidewire"}) {
    SCOPED_TRACE(example);
    checked += checked_changes(TracedDeck(deck(example), {"path.jumps=false"}));
  }
  EXPECT_GE(checked, 5);
}

// Of a path with both.
TEST(EventKinds, LimitPointsAreMaximaOrMinima) {
  for (const char* example : {"channel", "truss", "lee"}) {
    SCOPED_TRACE(example);
    const TracedDeck traced(test::example(example), {"path.jumps=false"});
    const auto& points = traced.record().points;
    int maxima = 0, minima = 0;
    for (const RecordEvent& event : traced.record().events) {
      const bool turns = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point;
      ASSERT_EQ(event.extremum.has_value(), turns);
      if (!turns || event.branch != 0) continue;
      const auto at = static_cast<std::size_t>(event.step);
      const bool maximum = event.extremum == Extremum::maximum;
      ++(maximum ? maxima : minima);
      EXPECT_EQ(points[at - 1].lambda < event.lambda, maximum);
      EXPECT_EQ(points[at + 1].lambda < event.lambda, maximum);
    }
    EXPECT_GE(maxima, 1);
    EXPECT_GE(minima, 1);
  }
}

}  // namespace arcwall::event_kinds_test
