#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// How far an end of a strand that lies on an obstacle from end to end is from where the obstacle bends or ends, out
/// from that end, less a millionth of the length scale. Large where the obstacle is straight for good.
class StraightEndBound final : public BoundOfEnd<BoundKind::straight_end> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
