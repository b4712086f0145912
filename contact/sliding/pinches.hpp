#pragma once

#include <vector>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

/// The places at rest where two obstacles that stand still leave a strand no clearance: smooth ones, of which the one
/// bends away from the strand more than the other bends towards it, or sharp corners of both. `rest`: a stress-free
/// state without points.
std::vector<Pinch> pinches_at_rest(const SlidingSetting& setting, const SlidingState& rest);

/// The active set with a point at each pinch, closed, made of that of a state without points.
ActiveSet pinched_active_set(const SlidingSetting& setting, const SlidingState& rest);

/// Whether the obstacles of a pinched point hold the axis's direction there. Of knife edges the moment of the point is
/// 0.
bool holds_direction(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point);

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
/// `other`: the second obstacle of the pinch.
CurvatureGap curvature_gap_beside(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool other,
                                  SlidingMesh::At side);

/// The angle between the axis at a knife edge and the flank of its corner before or behind it, > 0 where the body is
/// off it [rad], and its derivative by the node's rotation.
struct FlankAngle {
  double value = 0.0, by_rotation = 0.0;
};
FlankAngle angle_to_flank(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool other,
                          SlidingMesh::At side);

/// The force of both obstacles on the axis at a pinched point, but for the couple that smooth ones make: its size
/// across the axis, > 0 where the first obstacle presses, and as a vector [force].
struct PinchingForce {
  double value = 0.0;
  Vec2 vector = Vec2::Zero();
};
PinchingForce pinching_force(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The obstacles that a tracked point touches: one, or the two of its pinch.
std::vector<std::size_t> obstacles_at(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point);

/// Whether an obstacle is one of these.
bool touches(const SlidingSetting& setting, const SlidingContactLayout& on, std::size_t point, std::size_t obstacle);

}  // namespace arcwall::sliding
