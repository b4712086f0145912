#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// What keeps the body from lying on an obstacle beside an end that supports hold on it: the curvature gap (8.5) of a
/// clamped end, the slope of a hinged one. Behind the bound the body lies on the obstacle from the end on. Positive
/// where none does, and where the body lies there already.
class ClampBound final : public ValidityBound {
 public:
  ClampBound(Index strand, bool last) : strand_(strand), last_(last) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  Index strand() const { return strand_; }
  bool last() const { return last_; }

 private:
  Index strand_;
  bool last_;
};

}  // namespace arcwall::sliding
