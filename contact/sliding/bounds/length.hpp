#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The length of the span between a tracked point and the next one, which touches the same obstacle. Behind the bound a
/// line has gathered to a point, or the gap between two parts on the wall has closed.
class LengthBound final : public ValidityBound {
 public:
  explicit LengthBound(std::size_t point) : point_(point) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  /// The point before the span.
  std::size_t point() const { return point_; }

 private:
  std::size_t point_;
};

}  // namespace arcwall::sliding
