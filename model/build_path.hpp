#pragma once

#include <vector>

#include "model/build_structure.hpp"
#include "model/model.hpp"

namespace arcwall {

/// What monitors are read off.
struct Measured {
  const Structure& structure;  ///< of the deck's mesh
  const Body& body;
  const Places& places;
  const ContactQuery* contacts = nullptr;    ///< of the system's states; null where there are none
  const UnilateralSystem* system = nullptr;  ///< what is traced
};

/// The deck's monitors as columns. Adds a problem for a component that its place does not have.
std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems);

/// How the deck's path is followed.
TraceOptions trace_options(const deck::Deck& deck, const Measured& from, const std::vector<MonitorColumn>& monitors,
                           DeckProblems& problems);

/// Values of λ that load increments lead to: those the deck lands on, in their order, and equal increments of at most
/// `step` between them.
std::vector<double> load_levels(const deck::Path& path);

}  // namespace arcwall
