#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// On which side of its surface an obstacle is, seen in the direction in which the surface runs.
enum class Side {
  above,  ///< to the left: the structure stays to the right of the surface, below one that runs with x
  below,  ///< to the right: the structure stays to the left of it, above one that runs with x
};

/// The sign of a distance to the left of a surface that is a gap.
constexpr double sign_of(Side side) { return side == Side::below ? 1.0 : -1.0; }

/// Over how much of the interval beside a point of a spline its curvature goes over from one cubic to the next: a path
/// along which the edge of a pressed part comes by would else have a kink, and no step beyond it would turn little
/// enough. What happens there happens earlier by as much.
constexpr double knot_rounding = 1e-5;

/// A function of a position and λ at one place: its value, its derivatives by x and z of the position, and its rate by
/// λ at a fixed position.
struct LinearField {
  double value = 0.0, x = 0.0, z = 0.0;
  double rate = 0.0;
};

/// The same with second derivatives, and the rates of the first ones by λ.
struct QuadraticField {
  double value = 0.0, x = 0.0, z = 0.0;
  double xx = 0.0, xz = 0.0, zz = 0.0;
  double rate = 0.0, x_rate = 0.0, z_rate = 0.0;
};

/// A place of a surface, as the obstacle is at rest, where the rate of its curvature jumps, as at a point of a spline.
/// A beam of bending stiffness EI that lies on it is pressed on by a force EI · jump there.
struct CurvatureRateJump {
  Vec2 place = Vec2::Zero();
  Vec2 tangent = Vec2::UnitX();  ///< in the surface's direction
  double jump = 0.0;             ///< of dκ/ds in this direction, κ > 0 where it turns to the left [1/length²]
  double half_width = 0.0;       ///< on both sides within which it goes over [length]
};

/// A corner of a surface that bodies touch with their axes, where it has no one direction: it is a knife edge to them.
struct SharpCorner {
  Vec2 place = Vec2::Zero();
  Vec2 before = Vec2::UnitX(), behind = Vec2::UnitX();  ///< tangents on both sides, in the surface's direction
};

/// A rigid obstacle in the plane, which λ may move. Its surface is a curve that has a direction, and the body stays on
/// one side of it: where the gap is not negative. All that contact asks is asked at a position and at λ.
///
/// Must hold: derivatives are those of the values, gap_slope() agrees with gap(), and where the gap vanishes its
/// gradient is the unit normal of the surface into the free side.
class Obstacle {
 public:
  virtual ~Obstacle() = default;

  virtual Side side() const = 0;

  /// Whether there is a surface that a point at this position may touch.
  virtual bool faces(const Vec2& position, double lambda) const = 0;

  /// The gap [length]: positive where the body may be, negative inside. Only where faces().
  virtual QuadraticField gap(const Vec2& position, double lambda) const = 0;

  /// The same without second derivatives. Where the obstacle does not face the position the value is infinite and its
  /// derivatives are 0.
  virtual LinearField gap_slope(const Vec2& position, double lambda) const = 0;

  /// The angle from the x-axis to the surface where it faces the position [rad]. Only where faces().
  virtual QuadraticField direction(const Vec2& position, double lambda) const = 0;

  /// The curvature of the surface there, > 0 where it turns to the left [1/length]. Only where faces().
  virtual LinearField curvature(const Vec2& position, double lambda) const = 0;

  /// The second derivative of the curvature by the length of the surface, at a place that touches it; where the rate of
  /// the curvature jumps without what the jump adds [1/length³]. Only where faces().
  virtual double curvature_second(const Vec2& position, double lambda) const = 0;

  /// A coordinate along the surface of what a position faces: continuous, and it goes on beyond the surface's ends.
  virtual double along(const Vec2& position, double lambda) const = 0;

  /// The arc length along the surface of the place that a position faces [length], in the direction in which the
  /// surface runs: where the gap vanishes its gradient is the unit tangent. Off an outline by half_height() it jumps by
  /// 2π times that somewhere. Only where faces().
  virtual QuadraticField arc_length(const Vec2& position, double lambda) const = 0;

  /// The length of a closed surface, after which arc_length() begins again; 0 of others [length].
  virtual double round_length() const { return 0.0; }

  /// Such coordinates, ascending, between which the surface turns by a small angle: where it is to be looked at so that
  /// nothing of it is missed, however small it is. The first and the last are its ends, infinite where it goes on.
  /// Empty: it is straight and goes on.
  virtual const std::vector<double>& knots() const = 0;

  /// Whether its curvature changes smoothly all along, so that a short part of it with one knot is like one without.
  /// Not so of surfaces with corners, nor of arcs between lines.
  virtual bool is_smooth() const { return false; }

  /// After how much of along() a closed surface begins again; 0 of one that has ends or goes on. Then knots() are those
  /// of one round, and along() jumps somewhere.
  virtual double period() const { return 0.0; }

  /// Whether a body that moves far at once may be outside of it on one side before and on another behind: a profile has
  /// one side only.
  virtual bool has_other_sides() const { return false; }

  /// A position as the obstacle at rest sees it.
  virtual Vec2 seen_at_rest(const Vec2& position, double /*lambda*/) const { return position; }

  /// How far from a position no surface is [length], at least. Only where has_other_sides().
  virtual double clearance(const Vec2& /*position*/, double /*lambda*/) const { return 0.0; }

  /// A place far inside an obstacle that a body is outside of, as it is at rest.
  virtual std::optional<Vec2> core() const { return std::nullopt; }

  /// The corners that have no rounding, as the obstacle is at rest; none where the body's outside is off its axis.
  virtual std::vector<SharpCorner> sharp_corners() const { return {}; }

  /// Where the rate of its curvature jumps, along the surface; none of surfaces that are smooth, and none where the
  /// curvature itself jumps.
  virtual std::span<const CurvatureRateJump> curvature_rate_jumps() const { return {}; }

  /// How far a position near such a place is beyond it, in the surface's direction [length].
  virtual LinearField beyond(const CurvatureRateJump& jump, const Vec2& position, double /*lambda*/) const {
    return {.value = jump.tangent.dot(position - jump.place), .x = jump.tangent.x(), .z = jump.tangent.y()};
  }

  /// How far the body's outside is from a position that touches: half the height of a body whose axis is looked at for
  /// its faces [length].
  virtual double half_height() const { return 0.0; }

  /// By how much λ moves the obstacle per unit, at most, as far as it is within a reach of the point about which it
  /// turns [length]; 0 of one that stands still.
  virtual double greatest_speed(double /*reach*/) const { return 0.0; }

  /// Points along the surface between two values of x, for pictures; along all of it if it has no part between them, or
  /// if it is no function of x.
  virtual std::vector<Vec2> outline(double from, double to, double lambda) const = 0;

  /// The unit vector along which the obstacle presses on a point that it faces.
  Vec2 normal(const Vec2& position, double lambda) const {
    const QuadraticField g = gap(position, lambda);
    return Vec2(g.x, g.z).normalized();
  }
};

}  // namespace arcwall
