#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// How far the held end of a strand that is pressed on an obstacle all along is off the obstacle, which a support or
/// an obstacle that moves brings about: zero, and negative where the strand peels off from that end.
class EndStaysBound final : public BoundOfEnd<BoundKind::end_stays> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
