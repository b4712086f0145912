#pragma once

#include <memory>
#include <vector>

#include "elements/kinked_springs.hpp"
#include "model/build_structure.hpp"
#include "model/model.hpp"

namespace arcwall {

/// What monitors are read off.
struct Measured {
  const Structure& structure;  ///< of the deck's mesh
  const Body& body;
  const Places& places;
  const ContactQuery* contacts = nullptr;  ///< of the system's states; null where there are none
  bool walls_are_rigid = false;            ///< their forces are unknowns, and not among those of the structure
  const KinkedSprings* kinked = nullptr;   ///< the same where laws have kinks; else null
};

/// What a component of a place is read from; null if the place has no such component.
std::shared_ptr<const Observable> shown_at(const Measured& from, const deck::Place& place, deck::Component component);

/// What the rate of a column is measured by.
Watch::Kind kind_of(const MonitorColumn& column, const deck::Deck& deck);

/// The deck's monitors as columns. Adds a problem for one that has nothing to show.
std::vector<MonitorColumn> monitor_columns(const deck::Deck& deck, const Measured& from, DeckProblems& problems);

}  // namespace arcwall
