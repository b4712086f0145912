#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The room between a tracked point and a clamped end of its strand, or one at several others, or a contact with
/// another obstacle: half an element. What touches beyond is another kind of contact, which is not modelled; an open
/// point is given up.
class RoomBound final : public BoundOfSegment<BoundKind::room> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  /// Whether a point is at one end of it.
  bool is_beside(const SlidingContactLayout& on, Index point) const;
};

}  // namespace arcwall::sliding
