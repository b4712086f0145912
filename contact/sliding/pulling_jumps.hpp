#pragma once

#include <optional>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// A place of a wall where the rate of its curvature jumps, so that it would pull on a part that lies across
/// (section 8.4 of docs/theory.md), seen from the edge of a pressed part.
struct PullingJump {
  CurvatureRateJump at{};
  NodeFunction distance{};  ///< from the edge to where the rate begins to go over; < 0 if the part is across [length]
  double held = 0.0;        ///< length of the part over which its pressure holds what the wall pulls [length]
};

/// The nearest of those that pull more than the pressure of the part holds, as far as the mesh shows it; the part may
/// lie across by some elements. Empty where there is none near, and at a point that is no edge.
std::optional<PullingJump> pulling_jump_ahead(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Whether the free span behind a point bridges such a place, with a pressed part on one side and none on the other.
bool bridges_pulling_jump(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

}  // namespace arcwall::sliding
