#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// A point of a member's axis in some state.
struct ShapePoint {
  double fraction = 0.0;             ///< of the member's stress-free length
  Vec2 position = Vec2::Zero();      ///< [length]
  Vec2 displacement = Vec2::Zero();  ///< from the stress-free shape [length]
  double rotation = 0.0;             ///< of the section, likewise [rad]
  double axial_force = 0.0;          ///< tension is positive [force]
  double moment = 0.0;  ///< positive where it adds to the curvature, travel along the member [force·length]
};

/// The axis of a member between two of its nodes: a cubic with the directions that it has there.
struct AxisCurve {
  Vec2 first = Vec2::Zero(), second = Vec2::Zero();  ///< ends [length]
  double angle1 = 0.0, angle2 = 0.0;                 ///< of the tangent there, with any winding number [rad]

  Vec2 position(double xi) const;     ///< ξ ∈ [0, 1]
  double angle(double xi) const;      ///< of the tangent, with the winding number of angle1 [rad]
  Vec2 integral_to(double xi) const;  ///< ∫ position dξ from 0
  double chord_angle() const;         ///< with the winding number of angle1 [rad]
};

/// What the part of a member behind a section exerts on the part before it.
struct Resultant {
  Vec2 force = Vec2::Zero();  ///< [force]
  double moment = 0.0;        ///< about the axis, positive anticlockwise [force·length]
};

/// A member between two nodes, now and stress-free, and what it carries: what is known at the nodes is continued by
/// equilibrium, under a load that is constant along the stress-free axis.
struct MemberStretch {
  double from = 0.0, to = 1.0;  ///< fractions of the member at its ends
  AxisCurve now{}, rest{};
  std::array<double, 2> shear{}, rest_shear{};  ///< angle of the axis against the section's normal, at the ends [rad]
  Resultant first{}, second{};

  ShapePoint at(double fraction) const;

  /// M at ξ as it follows from the first end and the forces.
  double balanced_moment(double xi) const;
};

/// The points at these fractions, which ascend, of a member of which these stretches are known. Where the stretches
/// that meet carry different forces (a load, a contact, a support), the point is there twice, before and behind.
std::vector<ShapePoint> sampled(std::span<const MemberStretch> stretches, std::span<const double> fractions);

}  // namespace arcwall
