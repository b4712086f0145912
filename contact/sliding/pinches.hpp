#pragma once

#include <vector>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// The places at rest where two obstacles that stand still leave a strand no clearance: smooth ones, of which the one
/// bends away from the strand more than the other bends towards it. `rest`: a stress-free state without points.
std::vector<Pinch> pinches_at_rest(const SlidingSetting& setting, const SlidingState& rest);

/// The piece with a point at each pinch, closed, made of that of a state without points.
Piece pinched_piece(const SlidingSetting& setting, const SlidingState& rest);

/// How far the axis at a pinched point is off its pinch, across it and along it [length], and by what angle [rad].
struct OffPinch {
  NodeFunction across{}, along{}, turned{};
};
OffPinch off_pinch(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// An equation that says where a point is along the body, with its derivatives.
struct BorderEquation {
  double value = 0.0;
  Row row{};
};

/// The derivative of the energy by the coordinate of a pinched point while its node stays [force]: the material's
/// energy n·r′ + M κ − W, W per stress-free length, behind the point less that before it (docs/theory.md, 8.11).
BorderEquation energy_by_sliding(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// How much more an obstacle bends towards the body than the body does on one side of a pinched point [1/length].
CurvatureGap curvature_gap_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                  std::size_t obstacle, SlidingMesh::At side);

/// The obstacles that a tracked point touches: one, or the two of its pinch.
std::vector<std::size_t> obstacles_at(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point);

/// Whether an obstacle is one of these.
bool touches(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point, std::size_t obstacle);

}  // namespace arcwall::sliding
