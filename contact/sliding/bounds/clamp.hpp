#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// What keeps the body from lying on an obstacle beside an end that supports hold on it: the curvature gap (8.5) of a
/// clamped end or one on a plane of symmetry, the slope of a hinged one. Behind the bound the body lies on the obstacle
/// from the end on, or, where an end on a roller touches, contact may move inside (LiesDownBound). Positive where no
/// obstacle is touched, and where the body lies there already.
class ClampBound final : public BoundOfEnd<BoundKind::clamp> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
