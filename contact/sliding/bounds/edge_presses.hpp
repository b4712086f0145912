#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// Whether a closed point is the edge of a part that its load presses on a straight wall, with a free span beside it.
/// There EI g″″ = −p̄ < 0 on the free side, with g = g′ = g″ = 0 at the edge: the gap opens by g‴ > 0 alone, so the
/// edge bears EI g‴ > 0 in every equilibrium.
bool must_press(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The force of such an edge. Only a mesh that does not follow the bending beside the edge, within √(EI/N) of it under
/// the tension N, lets it vanish: there is no equilibrium behind the bound.
class EdgePressesBound final : public BoundOfPoint<BoundKind::edge_presses> {
 public:
  using BoundOfPoint::BoundOfPoint;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
