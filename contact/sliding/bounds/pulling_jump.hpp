#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// How far the edge of a pressed part is from the next place ahead of it where the rate of the wall's curvature jumps
/// so that the wall would have to pull on the part there. Behind the bound an arch opens across that place.
class PullingJumpBound final : public ValidityBound {
 public:
  /// `point`: the edge.
  explicit PullingJumpBound(std::size_t point) : point_(point) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  std::size_t point() const { return point_; }

 private:
  std::size_t point_;
};

}  // namespace arcwall::sliding
