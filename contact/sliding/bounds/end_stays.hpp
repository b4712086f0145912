#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// How far the held end of a strand that is pressed on an obstacle all along is off the obstacle, which a support or
/// an obstacle that moves brings about: zero, and negative where the strand peels off from that end.
class EndStaysBound final : public ValidityBound {
 public:
  EndStaysBound(Index strand, bool last) : strand_(strand), last_(last) {}
  Index strand() const { return strand_; }
  bool last() const { return last_; }
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  Index strand_;
  bool last_;
};

}  // namespace arcwall::sliding
