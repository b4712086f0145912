#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The moment by which an obstacle holds the slope of a hinged end up to which a strand is pressed on it: behind the
/// bound it would have to pull, and the strand peels off from the end.
class HoldingMomentBound final : public ValidityBound {
 public:
  /// By its number among the pressed tips of the layout.
  explicit HoldingMomentBound(std::size_t tip) : tip_(tip) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t tip_;
};

}  // namespace arcwall::sliding
