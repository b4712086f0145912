#pragma once

#include <vector>

#include "apps/build_structure.hpp"
#include "apps/study.hpp"

namespace arcwall {

/// The deck's monitors as columns. Adds a problem for a component that its place does not have.
std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Structure& structure, const Places& places,
                                           DeckProblems& problems);

/// How the deck's path is followed.
TraceOptions trace_options(const deck::Deck& deck, const Structure& structure, const Places& places,
                           const std::vector<MonitorColumn>& monitors, DeckProblems& problems);

}  // namespace arcwall
