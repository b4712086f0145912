#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// How much more an obstacle of a pinch bends towards the body than the body does on one side, or by what angle the
/// body is off a flank of a knife edge: behind the bound the body would wrap round that obstacle, which is not
/// modelled.
class PinchBound final : public BoundOfKind<BoundKind::pinch> {
 public:
  /// `other`: the second of the pinch's obstacles.
  PinchBound(std::size_t point, SlidingMesh::At side, bool other) : point_(point), side_(side), other_(other) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t point_;
  SlidingMesh::At side_;
  bool other_;
};

}  // namespace arcwall::sliding
