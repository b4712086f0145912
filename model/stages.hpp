#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/deck/deck.hpp"

namespace arcwall {

/// Where a movement from its stage takes hold of its point: the displacement [length] and the rotation [rad] from the
/// stress-free state, in the user's coordinates.
struct GripPlace {
  double x = 0.0, z = 0.0, rotation = 0.0;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(x, z, rotation);
  }
};

/// Stores the accumulated factor of a quantity scaled by λ: the sum of λ at the ends of its stages.
struct DrivenThing {
  std::string name{};  ///< as in `drives` of a stage: `load.0`, `prescribed.1`, `wall.hill`
  double gone = 0.0;
  GripPlace grip{};  ///< of a movement that begins from its stage
};

/// Stores how a stage has ended.
struct StageEnd {
  double lambda = 0.0;
  std::vector<GripPlace> grips{};  ///< of grips_of() the next stage

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(lambda, grips);
  }
};

/// Returns the numbers of the movements that take hold of their points as a stage begins, where these are then.
std::vector<std::size_t> grips_of(const deck::Deck& deck, std::size_t stage);

/// Returns all quantities of a deck that λ may scale, with factor 0.
std::vector<DrivenThing> things_to_drive(const deck::Deck& deck);

/// The deck that a stage traces: λ multiplies what it drives, from where that has gone, and all else is constant there.
/// A deck without stages is traced itself.
std::shared_ptr<const deck::Deck> deck_of_stage(const std::shared_ptr<const deck::Deck>& whole, std::size_t stage,
                                                const std::vector<DrivenThing>& progress);

/// Whether stages drive loads along a member, so that it and its neighbours may be loaded alike in one stage and not in
/// another.
bool is_driven_apart(const deck::Deck& deck, const std::string& member);

/// Returns the accumulated factors after a stage, and where the next one takes hold of points; `end.grips` has one
/// entry for each of its grips.
std::vector<DrivenThing> progress_after(const deck::Deck& deck, std::size_t stage, const StageEnd& end,
                                        std::vector<DrivenThing> progress);

}  // namespace arcwall
