#pragma once

#include <cstddef>
#include <optional>

#include "contact/sliding/placed_bound.hpp"

namespace arcwall::sliding {

/// The sine of the angle at which the body leaves an obstacle from an end on that touches it; < 0 where it would enter.
double sine_from_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);
Row sine_from_end_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// Of the closed contacts of an end of a strand the one whose obstacle the body leaves at the least angle: its number
/// among the free ends. An end in a corner between walls touches several. None where the end does not touch, where the
/// body lies on an obstacle beside it, or at a plane of symmetry that the obstacle crosses at right angles.
std::optional<std::size_t> end_nearest_to_lying_down(const SlidingSetting& setting, const SlidingState& at,
                                                     const StrandEnd& of);

/// How fast the gap grows from a free end, or one on a roller, on that touches: behind the bound a tip lies down on the
/// wall, or contact moves inside. Positive where the end does not touch.
class LiesDownBound final : public BoundOfEnd<BoundKind::lies_down> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

/// How far a free end that touches is from standing upright: behind the bound its section's other corner would touch,
/// which is not modelled. Positive where the end does not touch, and at a joint in line, which has no such corner.
class UprightBound final : public BoundOfEnd<BoundKind::upright> {
 public:
  using BoundOfEnd::BoundOfEnd;
  double value(const SlidingSetting& setting, const SlidingState& at) const override;
  Row gradient(const SlidingSetting& setting, const SlidingState& at) const override;
  std::vector<Transition> transitions(const SlidingSetting& setting, const SlidingState& at,
                                      const Arrival& arrival) const override;
};

}  // namespace arcwall::sliding
