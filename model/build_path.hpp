#pragma once

#include <vector>

#include "model/build_structure.hpp"
#include "model/model.hpp"

namespace arcwall {

/// What monitors are read off.
struct Measured {
  const deck::Deck& deck;
  const Structure& structure;
  const SlidingStructure* sliding;          ///< if the states are those of contact that slides; else null
  const IncrementalStructure* incremental;  ///< of load increments; else null
  const Places& places;
};

/// The deck's monitors as columns. Adds a problem for a component that its place does not have.
std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& body, DeckProblems& problems);

/// How the deck's path is followed.
TraceOptions trace_options(const deck::Deck& deck, const Measured& body, const std::vector<MonitorColumn>& monitors,
                           DeckProblems& problems);

/// Values of λ that load increments lead to: those the deck lands on, in their order, and equal increments of at most
/// `step` between them.
std::vector<double> load_levels(const deck::Path& path);

}  // namespace arcwall
