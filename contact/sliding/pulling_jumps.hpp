#pragma once

#include <algorithm>
#include <optional>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// A place of a wall where the rate of its curvature jumps, so that it would pull on a part that lies across
/// (section 8.4 of docs/theory.md), seen from the edge of a pressed part.
struct PullingJump {
  CurvatureRateJump at{};
  std::size_t segment = 0;  ///< the part
  double place = 0.0;       ///< in the part, by CurvePressure; the edge's while the part does not lie across
  NodeFunction distance{};  ///< from the edge to where the rate begins to go over; < 0 if the part is across [length]
  double held = 0.0;        ///< length of the part over which its pressure holds what the wall pulls [length]
  double left = 0.0;        ///< of the pressure at the place, less what has to hold the pull [force/length]

  /// The edge may lie where it does as long as this is not negative: it has not come there, or the part's pressure
  /// holds what the wall pulls. Without unit.
  double room(const ContactScales& scales) const {
    return std::max(distance.value / scales.length, left * scales.length / scales.force);
  }
};

/// The force with which a wall would pull on a strand that lies across such a place; < 0 where it pushes.
double pull(const SlidingSetting& setting, const MaterialPoint& place, std::size_t obstacle,
            const CurvatureRateJump& jump);

/// The length of a part whose pressure has to hold such a pull: where more is needed its mesh shows the arch.
struct LengthToHold {
  double value = 0.0;       ///< [length]
  double by_element = 0.0;  ///< its derivative by the length of the part's elements
};
LengthToHold length_to_hold(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);

/// How far the place of a touch is beyond a jump, in the surface's direction [length].
NodeFunction beyond(const Obstacle& wall, const CurvatureRateJump& jump, const Touch& touch, const SlidingState& at);

/// Of those near an edge, or in the half of the part beside it, the one with the least room. Empty where there is none,
/// and at a point that is no edge.
std::optional<PullingJump> pulling_jump_beside(const SlidingSetting& setting, const SlidingState& at,
                                               std::size_t point);

/// The derivatives of its room by all unknowns and by λ.
Row room_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point, const PullingJump& jump);

/// How far ahead of a tracked point along the body the nearest place is where the rate of the wall's curvature jumps so
/// that it pushes; < 0 behind it. Empty where there is none within a reach [length].
std::optional<double> pushing_jump_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                          double reach);

/// Whether the free span behind a point bridges such a place, with a pressed part on one side and none on the other.
bool bridges_pulling_jump(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

}  // namespace arcwall::sliding
