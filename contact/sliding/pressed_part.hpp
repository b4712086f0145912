#pragma once

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// Whether the part to which a pressed node belongs lies on a straight obstacle.
bool lies_on_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Whether a pressed part hands point loads on, be it at a plane of symmetry, and lies on its straight obstacle by
/// itself but for these.
bool part_needs_no_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);

/// The pressure on a pressed part, seen from one of its nodes: up to the middles of the elements on both sides, and
/// from the first and the last node up to the end of the part. By (8.7) of docs/theory.md, which is exact on a straight
/// obstacle. Where the rate of a curved one's curvature jumps so that it pulls, less what the pressure has to hold
/// there.
struct LeastPressure {
  double value = 0.0;  ///< force per length of axis; < 0 where the part would lift off
  double s = 0.0;      ///< material coordinate of the place where it is least [length]
};
LeastPressure least_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Its derivatives by all unknowns and by λ.
Row least_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Its derivative along a direction.
double least_pressure_rate(const SlidingSetting& setting, const SlidingMotion& motion, std::size_t node);

/// What a linear pressure p, which changes by Δ over an element, makes at the end of a part that is pressed with so
/// many of them: the force h (½ p + `force_by_change` Δ) and the moment (h²/12) (p + `moment_by_change` Δ) of the node
/// there.
struct PressureOfEndElement {
  double force_by_change = 0.0, moment_by_change = 0.0;  // [-]
};
PressureOfEndElement pressure_of_end_element(int elements);

/// What the pressure of a pressed part adds to the force of the node at one of its ends.
struct PressureAtEnd {
  double force = 0.0;   ///< of the wall, by the end's shape function [force]
  double length = 0.0;  ///< of axis for which it stands: half an element
};
PressureAtEnd pressure_at_end(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, bool last);

/// Fewest elements of a part that is pressed on a straight obstacle, or on a curved one, which it has to follow.
constexpr int fewest_pressed(bool straight) { return straight ? 2 : 8; }

}  // namespace arcwall::sliding
