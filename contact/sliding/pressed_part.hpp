#pragma once

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// Whether the part to which a pressed node belongs lies on a straight obstacle.
bool lies_on_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Whether a pressed part hands point loads on, and lies on its straight obstacle by itself but for these.
bool part_needs_no_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment);

/// The pressure on a pressed part, seen from one of its nodes: up to the middles of the elements on both sides, and
/// from the first and the last node up to the end of the part. On a straight obstacle by (8.7), which is exact there;
/// on a curved one by the forces of the nodes (8.11).
struct LeastPressure {
  double value = 0.0;  ///< force per length of axis; < 0 where the part would lift off
  double s = 0.0;      ///< material coordinate of the place where it is least [length]
};
LeastPressure least_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Its derivatives by all unknowns and by λ.
Row least_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t node);

/// Fewest elements of a part that is pressed on a straight obstacle, or on a curved one, where four forces and more
/// show the pressure up to the ends.
constexpr int fewest_pressed(bool straight) { return straight ? 2 : 8; }

}  // namespace arcwall::sliding
