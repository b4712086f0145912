#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall {

/// Stores the accumulated factor of a quantity scaled by λ: the sum of λ at the ends of its stages.
struct DrivenThing {
  std::string name{};  ///< as in `drives` of a stage: `load.0`, `prescribed.1`, `wall.hill`
  double gone = 0.0;
};

/// Returns all quantities of a deck that λ may scale, with factor 0.
std::vector<DrivenThing> things_to_drive(const deck::Deck& deck);

/// The deck that a stage traces: λ multiplies what it drives, from where that has gone, and all else is constant there.
/// A deck without stages is traced itself.
std::shared_ptr<const deck::Deck> deck_of_stage(const std::shared_ptr<const deck::Deck>& whole, std::size_t stage,
                                                const std::vector<DrivenThing>& progress);

/// Whether stages drive loads along a member, so that it and its neighbours may be loaded alike in one stage and not in
/// another.
bool is_driven_apart(const deck::Deck& deck, const std::string& member);

/// Returns the accumulated factors after a stage that ended at λ.
std::vector<DrivenThing> progress_after(const deck::Stage& stage, double lambda, std::vector<DrivenThing> progress);

}  // namespace arcwall
