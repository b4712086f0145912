#pragma once

#include <span>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// A point of a member's axis in some state.
struct ShapePoint {
  double fraction = 0.0;             ///< of the member's stress-free length
  Vec2 position = Vec2::Zero();      ///< [length]
  Vec2 displacement = Vec2::Zero();  ///< from the stress-free shape [length]
  double angle = 0.0;                ///< of the section's normal, the direction of travel where nothing shears [rad]
  double rotation = 0.0;             ///< of the section, from the stress-free shape [rad]
  double axial_force = 0.0;          ///< tension is positive [force]
  double shear_force =
      0.0;  ///< part across the section, to the left, of the far part's force on the near one: −dM/ds [force]
  double moment = 0.0;  ///< positive where it adds to the curvature, travel along the member [force·length]
};

/// The axis of a member between two of its nodes: a cubic with the directions that it has there.
class AxisCurve {
 public:
  AxisCurve() = default;

  /// Ends [length] and angles of the tangent there, with any winding number [rad].
  AxisCurve(const Vec2& first, const Vec2& second, double angle1, double angle2);

  const Vec2& first() const { return first_; }

  /// The same, travelled the other way.
  AxisCurve reversed() const;

  /// Between two of its places, ξ1 < ξ2.
  AxisCurve part(double xi1, double xi2) const;

  Vec2 position(double xi) const;     ///< ξ ∈ [0, 1]
  Vec2 integral_to(double xi) const;  ///< ∫ position dξ from 0
  double angle(double xi) const;      ///< of the tangent, with the winding number of angle1 [rad]

 private:
  Vec2 derivative(double xi) const;

  Vec2 first_ = Vec2::Zero(), chord_ = Vec2::UnitX();
  Vec2 derivative1_ = Vec2::UnitX(), derivative2_ = Vec2::UnitX();
  double angle1_ = 0.0;
};

/// Of v, with the winding number of another angle [rad].
double angle_near(const Vec2& v, double other);

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
  double shear = 0.0, rest_shear = 0.0;  ///< angle of the axis against the section's normal [rad]
  Resultant first{}, second{};

  ShapePoint at(double fraction) const;

  /// The same stretch of a member that travels the other way; for sections across the axis alone.
  MemberStretch reversed() const;

  /// N and M at ξ, alone.
  double axial_force(double xi) const;
  double moment(double xi) const;

  /// M at ξ as it follows from the first end and the forces.
  double balanced_moment(double xi) const;
};

/// A point load on a stretch between its ends.
struct PointLoadInside {
  double at = 0.0;            ///< as MemberStretch::from and to
  Vec2 force = Vec2::Zero();  ///< [force]
};

/// Divides a stretch at the point loads that act on it, which ascend: its forces jump there. `whole.first` and
/// `whole.second` balance the loads and a load that is constant along the axis.
void add_between_loads(const MemberStretch& whole, std::span<const PointLoadInside> loads,
                       std::vector<MemberStretch>& to);

/// The points at these fractions, which ascend, of a member of which these stretches are known. Where the stretches
/// that meet carry different forces (a load, a contact, a support), the point is there twice, before and behind.
std::vector<ShapePoint> sampled(std::span<const MemberStretch> stretches, std::span<const double> fractions);

}  // namespace arcwall
