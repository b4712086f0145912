#include "tests/support/explore.hpp"

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

}  // namespace arcwall::test
