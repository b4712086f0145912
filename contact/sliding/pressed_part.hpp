#pragma once

#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// The pressure on a pressed part, seen from one of its nodes: up to the middles of the elements on both sides, and
/// from the first and the last node up to the end of the part.
struct LeastPressure {
  double value = 0.0;     ///< force per length of axis; < 0 where the part would lift off
  double s = 0.0;         ///< material coordinate of the place where it is least [length]
  std::size_t first = 0;  ///< the first pressed node of the part
  Vector weights{};       ///< of the forces of the part's nodes: their sum is `value` times the length of an element
  double element = 0.0;   ///< length of an element of the part [length]
};
LeastPressure least_pressure(const SlidingState& at, std::size_t node);

}  // namespace arcwall::sliding
