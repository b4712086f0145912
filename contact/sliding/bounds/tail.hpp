#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The length of a strand between a tracked point and a tip, or a clamp up to which the body lies on the wall. Behind
/// the bound the contact has passed to the tip, or the stretch on the wall has gathered at the end; an open point
/// beside a tip is given up, as the tip watches on.
class TailBound final : public ValidityBound {
 public:
  TailBound(Index strand, bool last, std::size_t point) : strand_(strand), last_(last), point_(point) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

  Index strand() const { return strand_; }
  bool last() const { return last_; }
  std::size_t point() const { return point_; }

 private:
  Index strand_;
  bool last_;
  std::size_t point_;
};

}  // namespace arcwall::sliding
