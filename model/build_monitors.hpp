#pragma once

#include <memory>
#include <vector>

#include "model/monitored.hpp"

namespace arcwall {

/// What the rate of a column is measured by.
Watch::Kind kind_of(const MonitorColumn& column, const deck::Deck& deck);

/// The deck's monitors as columns. Adds a problem for one that has nothing to show.
std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems);

}  // namespace arcwall
