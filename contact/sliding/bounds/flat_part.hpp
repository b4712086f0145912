#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The length of a flat part that has one element, over half a wave of its buckling (8.6): behind the bound it has
/// elements of its own.
class HalfWaveBound final : public BoundOfSegment<BoundKind::half_wave> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// The reverse: behind the bound, at 0.8 of half a wave, a flat part with elements of its own has one again.
class StraightBound final : public BoundOfSegment<BoundKind::straight> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// The longest stretch of a part without pressure between the point loads that it hands on and its ends: behind the
/// bound it buckles between them, which the nodes pressed on the wall would hide.
class LoadedPartBound final : public BoundOfSegment<BoundKind::loaded_part> {
 public:
  using BoundOfSegment::BoundOfSegment;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
