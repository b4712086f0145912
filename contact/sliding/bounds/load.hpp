#pragma once

#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The room between a tracked point and a point load that has a node: half an element. Behind the bound the load acts
/// inside an element, so that the point may come to it and pass it.
class LoadAheadBound final : public ValidityBound {
 public:
  explicit LoadAheadBound(std::size_t segment) : segment_(segment) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t segment_;
};

/// The reverse: behind the bound, at three quarters of an element from the nearest tracked point, a load that acts
/// inside an element has a node again.
class LoadBehindBound final : public ValidityBound {
 public:
  LoadBehindBound(Index strand, Index load) : strand_(strand), load_(load) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  Index strand_, load_;
};

/// A part on a wall and a load inside an element. Inside a pressed part the load must press, from which it is handed on
/// to the wall; behind the bound it pulls the part off. On a part without pressure loads are not modelled: the bound is
/// how far outside they are, in elements.
class LoadOnPartBound final : public ValidityBound {
 public:
  LoadOnPartBound(Index load, std::size_t segment) : load_(load), segment_(segment) {}
  std::size_t segment() const { return segment_; }
  PartLoad load(const SlidingState& at) const;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  Index load_;
  std::size_t segment_;
};

}  // namespace arcwall::sliding
