#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The force that presses a tip on the obstacle on which a part is pressed up to there: behind the bound it lifts
/// the tip, and the part peels off from there, however little it is. The pressure beside the tip, of which its contact
/// bears a share, does not hold it. Negative where the tip does not touch.
class TipPressesBound final : public BoundOfEnd<BoundKind::tip_presses> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
