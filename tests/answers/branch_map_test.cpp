// How branches hang together, against closed forms of two bars.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "answers/branch_map.hpp"
#include "apps/output/branch_map_page.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::branch_map_test {
namespace {

using test::TracedDeck;

// Two bars that a constant load of 2 pulls up, so that the load is λ − 2. They snap where it is ±2 h³ EA/(3√3 L³).
const std::string pulled_up =
    test::low_truss + test::force("top", 0.0, 2.0, test::constant) +
    test::path(R"(step = 0.3; branches = "primary"; jumps = true; stop = { lambda = [-3.0, 8.0] })");

double snap_load() { return 2e4 / (3.0 * std::sqrt(3.0) * std::pow(101.0, 1.5)); }

std::vector<const BranchMapEdge*> edges_of(const BranchMap& map, const std::string& kind) {
  std::vector<const BranchMapEdge*> found;
  for (const BranchMapEdge& edge : map.edges)
    if (edge.kind == kind) found.push_back(&edge);
  return found;
}

}  // namespace

TEST(BranchMap, HasASegmentBetweenEventsAndAnEdgeAnEvent) {
  const TracedDeck traced(pulled_up);
  const Record& record = traced.record();
  const BranchMap map = branch_map_of(traced.model(), record);
  ASSERT_EQ(map.segments.size(), 3u);
  const std::vector<double> ends{0.0, 2.0 + snap_load(), 2.0 - snap_load(), 8.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(record.points[map.segments[i].first].lambda, ends[i], 1e-9);
    EXPECT_NEAR(record.points[map.segments[i].last].lambda, ends[i + 1], 1e-9);
    EXPECT_EQ(map.segments[i].unstable, i == 1 ? 1 : 0);
    EXPECT_EQ(map.segments[i].contact_pattern, "");
  }
  const auto limits = edges_of(map, "limit-point");
  ASSERT_EQ(limits.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(limits[i]->from, i);
    EXPECT_EQ(limits[i]->to, i + 1);
    ASSERT_EQ(limits[i]->events.size(), 1u);
    EXPECT_EQ(record.events[static_cast<std::size_t>(limits[i]->events[0])].kind, EventKind::limit_point);
  }
  const auto falls = edges_of(map, "jump");
  ASSERT_FALSE(falls.empty());
  EXPECT_EQ(falls[0]->from, 0u);
  EXPECT_EQ(falls[0]->to, 2u);
}

// By symmetry both stable states have the same energy where nothing loads the bars, at λ = 2: there they exchange.
TEST(BranchMap, SaysWhichStateHasTheLeastEnergy) {
  const TracedDeck traced(pulled_up);
  const BranchMap map = branch_map_of(traced.model(), traced.record());
  const auto at = [&](double lambda) {
    return *std::find_if(map.ranges.begin(), map.ranges.end(),
                         [&](const BranchMapRange& range) { return range.low <= lambda && lambda <= range.high; });
  };
  EXPECT_EQ(at(1.0).stable, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(at(1.0).states, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(at(1.0).least, 0u);
  EXPECT_NEAR(at(1.0).high, 2.0, 1e-3);
  EXPECT_EQ(at(3.0).least, 2u);
  EXPECT_EQ(at(7.0).stable, (std::vector<std::size_t>{2}));
  EXPECT_EQ(at(-1.0).stable, (std::vector<std::size_t>{2}));
  for (std::size_t i = 0; i + 1 < map.ranges.size(); ++i) EXPECT_EQ(map.ranges[i].high, map.ranges[i + 1].low);
}

// A cubic by values and slopes errs with the fourth power of the steps.
TEST(BranchMap, InterpolatesTheEnergyByItsSlope) {
  std::vector<double> errors;
  for (const char* const step : {"0.002", "0.0005"}) {
    const TracedDeck traced(pulled_up, {std::string("path.max_step=") + step, "path.step=0.02"});
    const BranchMap map = branch_map_of(traced.model(), traced.record());
    const auto exchange = std::find_if(map.ranges.begin(), map.ranges.end(), [](const BranchMapRange& range) {
      return range.least == 0u && range.high > 1.5;
    });
    ASSERT_NE(exchange, map.ranges.end());
    errors.push_back(std::abs(exchange->high - 2.0));
  }
  EXPECT_LT(errors[0], 1e-5);
  EXPECT_LT(errors[1], 0.01 * errors[0]);
}

// The metric of a path changes along it, and so does what a rate by its length means: slopes by λ do not. Of the arch
// the exchange is the same with steps a twentieth as long.
TEST(BranchMap, InterpolatesWhereTheMetricChanges) {
  std::vector<double> exchanges;
  for (const char* const step : {"0.2", "0.01"}) {
    const TracedDeck traced(test::example("arch"), {std::string("path.max_step=") + step});
    const BranchMap map = branch_map_of(traced.model(), traced.record());
    ASSERT_GE(map.ranges.size(), 2u);
    exchanges.push_back(map.ranges[1].high);
  }
  EXPECT_NEAR(exchanges[0], 419.3458, 1e-3);
  EXPECT_NEAR(exchanges[0], exchanges[1], 1e-5);
}

// Two branches with the same loads and energies at their ends are images of each other.
TEST(BranchMap, MergesMirrorImages) {
  const TracedDeck traced(pulled_up);
  Record twice = traced.record();
  const std::size_t points = twice.points.size(), events = twice.events.size();
  twice.branches.push_back(twice.branches[0]);
  twice.branches[1].id = 1;
  for (std::size_t i = 0; i < points; ++i) {
    RecordPoint copy = twice.points[i];
    copy.branch = 1;
    twice.points.push_back(copy);
  }
  for (std::size_t i = 0; i < events; ++i) {
    RecordEvent copy = twice.events[i];
    copy.branch = 1;
    copy.jump = nullptr;
    twice.events.push_back(copy);
  }
  const BranchMap map = branch_map_of(traced.model(), twice);
  ASSERT_EQ(map.segments.size(), 3u);
  for (const BranchMapSegment& segment : map.segments) EXPECT_EQ(segment.images, std::vector<Index>{1});
  for (const BranchMapEdge& edge : map.edges) EXPECT_LT(edge.from, 3u);
}

// A column in a channel: its arcs are told by their contacts.
TEST(BranchMap, TellsContacts) {
  const TracedDeck traced(test::example("channel"));
  const BranchMap map = branch_map_of(traced.model(), traced.record());
  std::vector<std::string> words;
  for (const BranchMapSegment& segment : map.segments)
    if (words.empty() || words.back() != segment.contact_pattern) words.push_back(segment.contact_pattern);
  EXPECT_EQ(words, (std::vector<std::string>{"", "upper", "upper upper", "upper lower upper"}));
  for (std::size_t i = 0; i + 1 < map.ranges.size(); ++i) EXPECT_EQ(map.ranges[i].high, map.ranges[i + 1].low);
  const auto json = branch_map_json(traced.record(), map);
  EXPECT_EQ(json["segments"].size(), map.segments.size());
  EXPECT_EQ(json["segments"][1]["contact_pattern"], "upper");
  const std::string section = branch_map_section(traced.record(), map);
  EXPECT_NE(section.find("<svg id=\"branch-map\""), std::string::npos);
  EXPECT_NE(section.find("upper lower upper (0)"), std::string::npos);
}

// Both branches that begin at a state that was found are joined there.
TEST(BranchMap, JoinsWhatWasFound) {
  const TracedDeck traced(pulled_up, {"path.search=true", "path.search_at=[1.0]", "path.search_guesses=10",
                                      "path.stop.event=\"limit-point\""});
  const BranchMap map = branch_map_of(traced.model(), traced.record());
  const auto found = edges_of(map, "search");
  ASSERT_EQ(found.size(), 2u);
  for (const BranchMapEdge* const edge : found) {
    EXPECT_EQ(edge->lambda, 1.0);
    ASSERT_TRUE(edge->to);
    EXPECT_EQ(map.segments[edge->from].unstable, map.segments[*edge->to].unstable);
  }
}

}  // namespace arcwall::branch_map_test
