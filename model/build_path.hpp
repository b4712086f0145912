#pragma once

#include <vector>

#include "model/build_monitors.hpp"

namespace arcwall {

/// How the deck's path is followed.
TraceOptions trace_options(const deck::Deck& deck, const Measured& from, const std::vector<MonitorColumn>& monitors,
                           DeckProblems& problems);

/// Values of λ that load increments lead to: those the deck lands on, in their order, and equal increments of at most
/// `step` between them.
std::vector<double> load_levels(const deck::Path& path);

}  // namespace arcwall
