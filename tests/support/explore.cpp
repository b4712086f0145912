#include "tests/support/explore.hpp"

#include <gtest/gtest.h>

#include <string>

namespace arcwall::test {

Graph explore(const System& system, const TraceOptions& trace, const ExploreOptions& options, const State& start,
              const std::vector<Watch>& watched) {
  Explorer explorer(system, start, trace, watched, options);
  Graph graph;
  while (auto step = explorer.next()) {
    const auto id = static_cast<std::size_t>(step->branch);
    if (graph.branches.size() <= id) graph.branches.resize(id + 1);
    graph.branches[id].arcs.push_back(std::move(step->arc));
  }
  graph.records = explorer.branches();
  graph.branches.resize(graph.records.size());
  for (std::size_t i = 0; i < graph.records.size(); ++i)
    graph.branches[i].end = graph.records[i].end.value_or(BranchEnd{.detail = "has no end"});
  return graph;
}

Graph explore(const System& system, const TraceOptions& trace, const ExploreOptions& options,
              const std::vector<Watch>& watched) {
  return explore(system, trace, options, rest(system), watched);
}

void expect_same_graphs(const Graph& found, const Graph& expected, const SameEvents& how) {
  ASSERT_EQ(found.records.size(), expected.records.size());
  for (std::size_t i = 0; i < found.records.size(); ++i) {
    SCOPED_TRACE("branch " + std::to_string(i));
    const BranchRecord &a = found.records[i], &b = expected.records[i];
    EXPECT_EQ(a.parent, b.parent);
    EXPECT_EQ(a.mirror_image, b.mirror_image);
    EXPECT_EQ(found.branches[i].end.reason, expected.branches[i].end.reason);
    EXPECT_EQ(found.branches[i].end.partner, expected.branches[i].end.partner);
    expect_same_events(events_of(found.branches[i]), events_of(expected.branches[i]), how);
  }
}

}  // namespace arcwall::test
