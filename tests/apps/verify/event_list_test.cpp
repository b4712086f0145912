#include "apps/verify/completeness.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/decks_with_events.hpp"
#include "tests/apps/verify/stored_files_of.hpp"

namespace arcwall::verify::event_list_test {

namespace {

using test::example;
using test::TracedDeck;

}  // namespace

namespace {

std::vector<ListedEvent> listed_events(const Record& record) {
  std::vector<ListedEvent> list;
  for (const RecordEvent& event : record.events) {
    list.push_back({.kind = std::string(to_text(event.kind)),
                    .branch = event.branch,
                    .step = event.step,
                    .unstable_before = event.unstable_before,
                    .unstable_after = event.unstable_after,
                    .lambda_uncertainty = event.lambda_uncertainty,
                    .unconfirmed = event.unconfirmed,
                    .monitor = event.monitor.value_or("")});
    for (const RecordContact& contact : event.contacts) list.back().contacts.push_back(contact.label);
  }
  return list;
}

std::optional<Failure> incompleteness(const TracedDeck& traced, const std::vector<ListedEvent>& events,
                                      const Record& record) {
  Findings findings;
  check_completeness(events, record, traced.model(), findings);
  return findings.first();
}

}  // namespace

// Whichever event is taken out of a right list, what it told is missed: but for one-sided branch points, where
// all that changes is told by the change of contact.
TEST(EventList, EveryEventThatIsRemovedIsMissed) {
  std::set<std::string> kinds;
  for (const TracedDeck& traced : decks_with_events()) {
    SCOPED_TRACE(traced.record().title);
    const std::vector<ListedEvent> events = listed_events(traced.record());
    ASSERT_FALSE(incompleteness(traced, events, traced.record()).has_value())
        << to_text(*incompleteness(traced, events, traced.record()));
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (events[i].kind == "start" || events[i].kind == "end" || events[i].unconfirmed) continue;
      const bool one_sided = events[i].kind == "branch-point" && events[i - 1].step == events[i].step;
      if (one_sided) continue;  // the points beside it know of the change of contact alone
      kinds.insert(events[i].kind);
      std::vector<ListedEvent> fewer = events;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const auto failure = incompleteness(traced, fewer, traced.record());
      EXPECT_TRUE(failure.has_value()) << events[i].kind << " at step " << events[i].step << " is not missed";
      if (!failure) continue;
      EXPECT_TRUE(failure->what.starts_with("the list of events is complete: ")) << failure->what;
    }
  }
  for (const char* kind : {"contact-closes", "contact-opens", "contact-spreads", "limit-point", "turning-point"})
    EXPECT_TRUE(kinds.contains(kind)) << kind;
}

TEST(EventList, AnEventThatIsNoneIsSeen) {
  const TracedDeck traced(example("lee"));
  std::vector<ListedEvent> events = listed_events(traced.record());
  const auto limit =
      std::find_if(events.begin(), events.end(), [](const ListedEvent& event) { return event.kind == "limit-point"; });
  ASSERT_NE(limit, events.end());
  ListedEvent false_one = *limit;
  false_one.step -= 2;
  false_one.unstable_after = false_one.unstable_before;
  events.insert(limit, false_one);
  const auto failure = incompleteness(traced, events, traced.record());
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->step, false_one.step);
  EXPECT_NE(failure->what.find("λ has no maximum or minimum"), std::string::npos) << failure->what;
}

TEST(EventList, ARowMovedFlippedOrBeyondTheBoundIsSeen) {
  const TracedDeck traced(example("arch"));
  const std::vector<ListedEvent> events = listed_events(traced.record());
  const auto no_event = [](const RecordPoint& point) { return point.step > 1 && !point.event; };
  const auto where =
      static_cast<std::size_t>(std::find_if(traced.record().points.begin(), traced.record().points.end(), no_event) -
                               traced.record().points.begin());
  const auto caught = [&](const std::function<void(RecordPoint&)>& change) {
    Record record = traced.record();
    change(record.points[where]);
    return incompleteness(traced, events, record).value_or(Failure{}).what;
  };
  const RecordPoint &before = traced.record().points[where - 1], &at = traced.record().points[where];
  EXPECT_NE(caught([](RecordPoint& point) { ++*point.count.unstable; }).find("without an event"), std::string::npos);
  // Beside the point before it, and a little beyond: λ turns twice.
  EXPECT_NE(caught([&](RecordPoint& point) {
              point.lambda = before.lambda - 0.1 * (at.lambda - before.lambda);
            }).find("λ has a maximum or minimum at step"),
            std::string::npos);
  EXPECT_NE(caught([](RecordPoint& point) { point.lambda = 1e3; }).find("has a maximum or minimum at step"),
            std::string::npos);
  Record record = traced.record();
  const deck::StopBounds& bounds = traced.model().deck().path.stop.bounds.front();
  ASSERT_EQ(bounds.name, "lambda");
  record.points.back().lambda = bounds.high + 1e-3;
  EXPECT_EQ(incompleteness(traced, events, record).value_or(Failure{}).what, "no point is beyond path.stop: lambda");
}

// Where a column touches between two nodes the mesh gets one, and λ may step back by the error that was there without.
TEST(EventList, LambdaMayStepBackWhereTheMeshGetsANode) {
  const TracedDeck traced(R"toml(
title = "A column that buckles against a curved wall"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 2.5e7, I = 1.0, height = 0.03 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
member.c = { from = "a", to = "b", theory = "euler-bernoulli", elements = 6, material = "m", section = "s" }
load = [{ at = "b", force = [-8.085, 0.0] }]
wall = [{ name = "upper", side = "above", profile = { type = "parabola", apex = [0.65, 0.03], curvature = 0.41 } }]
path = { step = 0.1, stop = { lambda = [-0.5, 1.0] } }
)toml");
  const std::vector<ListedEvent> events = listed_events(traced.record());
  const auto closes = test::events_of(traced, EventKind::contact_closes);
  ASSERT_FALSE(closes.empty());
  const auto at = std::find_if(
      traced.record().points.begin(), traced.record().points.end(),
      [&](const RecordPoint& point) { return point.branch == closes[0].branch && point.step == closes[0].step; });
  const auto moved = [&](std::ptrdiff_t row, double by) {
    Record record = traced.record();
    record.points[static_cast<std::size_t>(at - traced.record().points.begin() + row)].lambda += by;
    return incompleteness(traced, events, record).value_or(Failure{}).what;
  };
  EXPECT_EQ(moved(-1, 1e-6), "");
  EXPECT_NE(moved(-1, 1e-2).find("λ has a maximum or minimum at step"), std::string::npos);
  EXPECT_NE(moved(-2, 1e-4).find("λ has a maximum or minimum at step"), std::string::npos);
}

// --- traced again
// -----------------------------------------------------------------------------------------------------

}  // namespace arcwall::verify::event_list_test
