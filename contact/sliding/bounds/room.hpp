#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The room between a tracked point and the end of its strand, or a contact with another obstacle: half an element.
/// What touches beyond is another kind of contact, which is not modelled; an open point is given up.
class RoomBound final : public ValidityBound {
 public:
  explicit RoomBound(std::size_t segment) : segment_(segment) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t segment_;
};

}  // namespace arcwall::sliding
