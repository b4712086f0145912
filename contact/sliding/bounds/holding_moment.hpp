#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The moment by which an obstacle holds the slope of an end up to which a part is pressed on it. Of a hinged end it
/// may push: behind the bound it would have to pull, and the part peels off from the end. Of a free one, which takes
/// none, it is nothing but what the pressure over an element makes of it on the mesh: behind the bounds of both signs a
/// moment on the tip arches the part off beside it, or lifts it.
class HoldingMomentBound final : public BoundOfKind<BoundKind::holding_moment> {
 public:
  enum class Against { pulling, lifting };

  /// By its number among the pressed tips of the layout.
  explicit HoldingMomentBound(std::size_t tip, Against what = Against::pulling) : tip_(tip), against_(what) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t tip_;
  Against against_;
};

}  // namespace arcwall::sliding
