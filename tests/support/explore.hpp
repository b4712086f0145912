#pragma once

#include <vector>

#include "continuation/explorer.hpp"
#include "tests/support/branch.hpp"

namespace arcwall::test {

/// A graph of branches, kept whole: branches[i] belongs to records[i].
struct Graph {
  std::vector<Branch> branches{};
  std::vector<BranchRecord> records{};
};

/// Traces from a state, or from rest, until every branch has ended.
Graph explore(const System& system, const TraceOptions& trace, const ExploreOptions& options, const State& start,
              const std::vector<Watch>& watched = {});
Graph explore(const System& system, const TraceOptions& trace, const ExploreOptions& options,
              const std::vector<Watch>& watched = {});

/// The same branches with the same origins, ends and events.
void expect_same_graphs(const Graph& found, const Graph& expected, const SameEvents& how = {});

}  // namespace arcwall::test
