#pragma once

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The curvature gap (8.5) of a tracked point beside which the body does not lie on the wall. Closed: beyond the bound
/// a zone, an arch or both begin. Open: the least gap that the point follows becomes shallow, and before it vanishes
/// the point must be given up, as nothing would say where it is; so it vanishes at once where an arc of the wall goes
/// over into a line, from which the body turns away.
class CurvatureBound final : public BoundOfPoint<BoundKind::curvature> {
 public:
  using BoundOfPoint::BoundOfPoint;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
