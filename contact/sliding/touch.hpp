#pragma once

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// A node of the body that touches an obstacle, or may.
struct Touch {
  Index strand, position;
  std::size_t obstacle;
  double offset;  ///< of the face that touches from the axis, along the obstacle's normal (upwards) [length]

  AxisPlace axis(const SlidingState& at) const { return at.mesh.node(strand, position, at.now); }
};

/// The node of contact j of an active set: a tracked point's or a free end's.
Touch touch_of_contact(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact);
Touch touch_of_end(const SlidingSetting& setting, const SlidingContactLayout& layout, const FreeEnd& end);

/// Whether a contact is that of a free end up to which the body lies on the same obstacle without pressure.
bool lies_flat(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact);

/// Whether a contact is that of an end on a plane of symmetry up to which the body is pressed on the same obstacle: it
/// is a node inside the zone of the whole body.
bool is_inside_zone(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact);

/// Whether the obstacle of an end on a plane of symmetry is parallel to the body there, as in the middle of the whole.
bool is_tangent_at_plane(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

Touch touch_of_node(const SlidingSetting& setting, const SlidingContactLayout::PressedNode& node);
Touch touch_of_tip(const SlidingSetting& setting, const SlidingContactLayout::PressedTip& tip);

/// 1 where an axis of this angle runs with the surface that a place faces, −1 where it runs against it.
double travel(const Obstacle& surface, const Vec2& place, double angle, double lambda);

/// The sine of the angle between body and wall has this sign at an end where the gap grows from there on.
constexpr double outward(Side side, bool last) { return (side == Side::below) == last ? -1.0 : 1.0; }

/// The place of the face at an offset: the section's normal looks along the obstacle's, or against it where the body
/// travels against x.
Vec2 face(double offset, const AxisPlace& axis);

/// The gap between the face and the obstacle [length]; infinite where the obstacle has no surface.
double face_gap(const SlidingObstacle& obstacle, double offset, const AxisPlace& axis, double lambda);
double face_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at);

/// A function of a node's x, z and rotation and of λ: its value and derivatives. The rates are at fixed unknowns: walls
/// may move with λ, and so may a support that holds one of the three.
struct NodeFunction {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  double rate = 0.0;                                        ///< of the value, by λ
  Eigen::Vector3d gradient_rate = Eigen::Vector3d::Zero();  ///< of the gradient, by λ
};

/// Gap and tilt of a touch. Only where the obstacle has a surface.
struct TouchGap {
  NodeFunction gap{};   ///< [length]
  NodeFunction tilt{};  ///< t, the angle between axis and obstacle, less whole half turns [rad]
  double angle = 0.0;   ///< the same with its winding number and the direction of travel
};
TouchGap touch_gap(const SlidingSetting& setting, const Touch& touch, const SlidingState& at);

/// The arc length along the obstacle, with the body to its left, of the place nearest to where friction acts at a
/// touch; of a closed obstacle the round that is nearest to `near` [length].
NodeFunction touched_place(const SlidingSetting& setting, const Touch& touch, const SlidingState& at, double near);

/// Adds what is given by a node's x, z and rotation to the places of these in a vector; held ones are left out.
void add_at_node(const NodeUnknowns& unknowns, const Eigen::Vector3d& values, Eigen::Ref<Vector> to);

}  // namespace arcwall::sliding
