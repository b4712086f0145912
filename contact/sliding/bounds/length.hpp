#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The length of the span between a tracked point and the next one, which touches the same obstacle. Behind the bound a
/// line has gathered to a point, or the gap between two parts on the wall has closed.
class LengthBound final : public BoundOfPoint<BoundKind::length> {
 public:
  using BoundOfPoint::BoundOfPoint;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
