#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/verify/plain_wall.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// Step of the differences that touches are looked at with: of the structure's length, or an angle.
constexpr double touch_difference = 1e-4;

/// A function of the unknowns of one node.
struct NodeFunction {
  std::vector<Index> unknowns{};  ///< x, z, rotation and changes of thickness; −1: a support holds it
  Vector at{};                    ///< their values
  Vector steps{};                 ///< with which differences are taken
  std::function<double(const Vector&)> of{};

  /// Its derivatives, in closed form; empty: they are found by differences, which are not right where a slope has a
  /// kink, nor second ones where a curvature jumps.
  std::function<Vector(const Vector&)> slopes{};
  std::function<Matrix(const Vector&)> bends{};

  /// Takes differences by x and z within a part of a length over which the function bends.
  void resolve(double length);

  double value() const { return of(at); }
  Vector gradient() const;  ///< 0 for what is held
  Matrix hessian() const;
};

/// Gives a gap to a wall with an outline its derivatives by x and z. `place`: of the axis, which the unknowns move.
void take_outline(const PlainWall& wall, const std::function<Vec2(const Vector&)>& place, NodeFunction& gap);

/// What friction does at a closed contact.
struct FrictionAtTouch {
  NodeFunction along{};      ///< distance along the wall's tangent at the contact
  double force = 0.0;        ///< T, as stored [force]
  double coefficient = 0.0;  ///< μ
  bool slips = false;
  double slip = 0.0;  ///< as stored [length]
};

/// A point of the structure against a wall.
struct Touch {
  ContactLabel label{};
  Vec2 place = Vec2::Zero();  ///< of the point that may touch
  NodeFunction gap{};         ///< infinite where the wall has no surface
  bool closed = false;
  double force = 0.0;       ///< as stored [force]
  double compliance = 0.0;  ///< gap of a spring per force [length/force]
  double stiffness = 0.0;   ///< spring beside the force, of the augmented Lagrangian [force/length]
  bool listed = true;       ///< in contacts.csv: nodes inside a pressed part are not
  bool two_sided = false;   ///< another touches the same point from the opposite side
  double against = 0.0;     ///< the force of that other [force]
  std::optional<FrictionAtTouch> friction{};
};

/// What the wall exerts: p, less the spring of the augmented Lagrangian.
inline double wall_force(const Touch& touch) { return touch.force - touch.stiffness * touch.gap.value(); }

/// A point of a mesh that slides, where the structure is tangent to the wall.
struct Tangency {
  ContactLabel label{};
  NodeFunction tilt{};          ///< angle between the axis and the wall [rad]
  double moment = 0.0;          ///< that holds it, as stored [force·length]
  bool end_of_pressed = false;  ///< where bending is continuous instead of the moment zero
  std::optional<double>
      spring{};             ///< second variation of a contact that slides; empty: the tilt is held [force·length]
  bool unresolved = false;  ///< an element of its strand turns so far that the mesh does not tell the spring
};

/// A place between two walls without clearance through which a member slides: what is there of it stays on the place
/// along the axis, too, and the material coordinate there is one more unknown of the energy.
struct Pinched {
  ContactLabel label{};
  NodeFunction along{};  ///< distance from the place [length]
  double force = 0.0;    ///< along the axis, as stored [force]
  Index coordinate = 0;  ///< of the material coordinate in State::x
  double step = 0.0;     ///< of that, with which differences are taken: small against the elements beside [length]
};

struct Touches {
  std::vector<Touch> all{};
  std::vector<ContactPoint> of_compliant_walls{};  ///< edges of pressed parts, and what elements bear between
  std::vector<Tangency> tangencies{};
  std::vector<Pinched> pinched{};
};

/// All touches of a state, of whatever kind of contact it has.
Touches touches(const Model& model, const std::vector<PlainWall>& walls, const State& state);

}  // namespace arcwall::verify
