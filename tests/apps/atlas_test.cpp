// How branches hang together, against closed forms of two bars.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/output/atlas_page.hpp"
#include "model/atlas.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::atlas_test {
namespace {

using test::TracedDeck;

// Two bars that a constant load of 2 pulls up, so that the load is λ − 2. They snap where it is ±2 h³ EA/(3√3 L³).
const std::string pulled_up = [] {
  std::string deck = test::low_truss + R"toml([path]
step = 0.3
branches = "primary"
landing = true
stop = { lambda = [-3.0, 8.0] }
)toml";
  const std::string load = "load = [{ at = \"top\", force = [0.0, -1.0] }]";
  return deck.replace(
      deck.find(load), load.size(),
      "load = [{ at = \"top\", force = [0.0, -1.0] }, { at = \"top\", force = [0.0, 2.0], constant = true }]");
}();

double snap_load() { return 2e4 / (3.0 * std::sqrt(3.0) * std::pow(101.0, 1.5)); }

std::vector<const AtlasEdge*> edges_of(const Atlas& atlas, const std::string& kind) {
  std::vector<const AtlasEdge*> found;
  for (const AtlasEdge& edge : atlas.edges)
    if (edge.kind == kind) found.push_back(&edge);
  return found;
}

}  // namespace

TEST(Atlas, HasANodeASmoothArcAndAnEdgeAnEvent) {
  const TracedDeck traced(pulled_up);
  const Record& record = traced.record();
  const Atlas atlas = atlas_of(traced.model(), record);
  ASSERT_EQ(atlas.nodes.size(), 3u);
  const std::vector<double> ends{0.0, 2.0 + snap_load(), 2.0 - snap_load(), 8.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(record.points[atlas.nodes[i].first].lambda, ends[i], 1e-9);
    EXPECT_NEAR(record.points[atlas.nodes[i].last].lambda, ends[i + 1], 1e-9);
    EXPECT_EQ(atlas.nodes[i].unstable, i == 1 ? 1 : 0);
    EXPECT_EQ(atlas.nodes[i].word, "");
  }
  const auto limits = edges_of(atlas, "limit-point");
  ASSERT_EQ(limits.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(limits[i]->from, i);
    EXPECT_EQ(limits[i]->to, i + 1);
    ASSERT_EQ(limits[i]->events.size(), 1u);
    EXPECT_EQ(record.events[static_cast<std::size_t>(limits[i]->events[0])].kind, EventKind::limit_point);
  }
  const auto falls = edges_of(atlas, "landing");
  ASSERT_FALSE(falls.empty());
  EXPECT_EQ(falls[0]->from, 0u);
  EXPECT_EQ(falls[0]->to, 2u);
}

// By symmetry both stable states have the same energy where nothing loads the bars, at λ = 2: there they exchange.
TEST(Atlas, SaysWhichStateHasTheLeastEnergy) {
  const TracedDeck traced(pulled_up);
  const Atlas atlas = atlas_of(traced.model(), traced.record());
  const auto at = [&](double lambda) {
    return *std::find_if(atlas.ranges.begin(), atlas.ranges.end(),
                         [&](const AtlasRange& range) { return range.low <= lambda && lambda <= range.high; });
  };
  EXPECT_EQ(at(1.0).stable, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(at(1.0).nodes, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(at(1.0).least, 0u);
  EXPECT_NEAR(at(1.0).high, 2.0, 1e-3);
  EXPECT_EQ(at(3.0).least, 2u);
  EXPECT_EQ(at(7.0).stable, (std::vector<std::size_t>{2}));
  EXPECT_EQ(at(-1.0).stable, (std::vector<std::size_t>{2}));
  for (std::size_t i = 0; i + 1 < atlas.ranges.size(); ++i) EXPECT_EQ(atlas.ranges[i].high, atlas.ranges[i + 1].low);
}

// A cubic by values and slopes errs with the fourth power of the steps.
TEST(Atlas, InterpolatesTheEnergyByItsSlope) {
  std::vector<double> errors;
  for (const char* const step : {"0.002", "0.0005"}) {
    const TracedDeck traced(pulled_up, {std::string("path.max_step=") + step, "path.step=0.02"});
    const Atlas atlas = atlas_of(traced.model(), traced.record());
    const auto exchange = std::find_if(atlas.ranges.begin(), atlas.ranges.end(),
                                       [](const AtlasRange& range) { return range.least == 0u && range.high > 1.5; });
    ASSERT_NE(exchange, atlas.ranges.end());
    errors.push_back(std::abs(exchange->high - 2.0));
  }
  EXPECT_LT(errors[0], 1e-5);
  EXPECT_LT(errors[1], 0.01 * errors[0]);
}

// Two branches with the same loads and energies at their ends are images of each other.
TEST(Atlas, MergesMirrorImages) {
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
    copy.landing = nullptr;
    twice.events.push_back(copy);
  }
  const Atlas atlas = atlas_of(traced.model(), twice);
  ASSERT_EQ(atlas.nodes.size(), 3u);
  for (const AtlasNode& node : atlas.nodes) EXPECT_EQ(node.images, std::vector<Index>{1});
  for (const AtlasEdge& edge : atlas.edges) EXPECT_LT(edge.from, 3u);
}

// A column in a channel: its arcs are told by their contacts.
TEST(Atlas, TellsContacts) {
  const TracedDeck traced(test::example("channel"));
  const Atlas atlas = atlas_of(traced.model(), traced.record());
  std::vector<std::string> words;
  for (const AtlasNode& node : atlas.nodes)
    if (words.empty() || words.back() != node.word) words.push_back(node.word);
  EXPECT_EQ(words, (std::vector<std::string>{"", "upper", "upper upper", "upper lower upper"}));
  for (std::size_t i = 0; i + 1 < atlas.ranges.size(); ++i) EXPECT_EQ(atlas.ranges[i].high, atlas.ranges[i + 1].low);
  const auto json = atlas_json(traced.record(), atlas);
  EXPECT_EQ(json["nodes"].size(), atlas.nodes.size());
  EXPECT_EQ(json["nodes"][1]["word"], "upper");
  const std::string section = atlas_section(traced.record(), atlas);
  EXPECT_NE(section.find("<svg id=\"atlas\""), std::string::npos);
  EXPECT_NE(section.find("upper lower upper (0)"), std::string::npos);
}

// Both branches that begin at a state that was found are joined there.
TEST(Atlas, JoinsWhatWasFound) {
  const TracedDeck traced(pulled_up, {"path.search=true", "path.search_at=[1.0]", "path.search_tries=10",
                                      "path.stop.event=\"limit-point\""});
  const Atlas atlas = atlas_of(traced.model(), traced.record());
  const auto found = edges_of(atlas, "found");
  ASSERT_EQ(found.size(), 2u);
  for (const AtlasEdge* const edge : found) {
    EXPECT_EQ(edge->lambda, 1.0);
    ASSERT_TRUE(edge->to);
    EXPECT_EQ(atlas.nodes[edge->from].unstable, atlas.nodes[*edge->to].unstable);
  }
}

}  // namespace arcwall::atlas_test
