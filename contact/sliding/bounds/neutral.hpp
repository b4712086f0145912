#pragma once

#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

/// The moments at the ends of a neutral span, and the force that holds its middle. Behind the bound nothing holds it:
/// the contact beside it bears a moment again, or the body is not symmetric.
class NeutralBound final : public BoundOfKind<BoundKind::neutral> {
 public:
  /// By its number in the layout.
  explicit NeutralBound(std::size_t span) : span_(span) {}
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  BoundPlace place(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;

 private:
  std::size_t span_;
};

}  // namespace arcwall::sliding
