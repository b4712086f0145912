#pragma once

#include <string>
#include <vector>

#include "contact/sliding/layout.hpp"

namespace arcwall {

struct SlidingSetting;
struct SlidingState;

/// A contact of a shape that was found on another mesh: at a place of a strand, or all along a part of it.
struct GivenContact {
  std::string wall{};
  Index strand = 0;
  double from = 0.0, to = 0.0;                    ///< material coordinates; equal where contact is at a point [length]
  double force_at_from = 0.0, force_at_to = 0.0;  ///< of a part; of a point the first is all of it [force]
  SlidingContactLayout::Span between = SlidingContactLayout::Span::free;  ///< how the body runs from `from` to `to`

  bool is_part() const { return to > from; }
  bool operator==(const GivenContact&) const = default;
};

namespace sliding {

/// The state with these contacts closed, of one in which all are open and whose shape is nearly theirs: a start for
/// Newton's method. Contacts that follow each other on a strand are given in their order. What is so near a tip that it
/// is a contact of the tip closes that. A flat part on which the body does not lie by itself is pressed.
State with_given_contacts(const SlidingSetting& setting, const SlidingState& open,
                          const std::vector<GivenContact>& contacts);

}  // namespace sliding

}  // namespace arcwall
