#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// How far the edge of a pressed part is from the next place ahead of it where the rate of the wall's curvature jumps
/// so that the wall would have to pull on the part there. Behind the bound an arch opens across that place.
class PullingJumpBound final : public BoundOfPoint<BoundKind::pulling_jump> {
 public:
  using BoundOfPoint::BoundOfPoint;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
