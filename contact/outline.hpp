#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/obstacle.hpp"

namespace arcwall {

/// The place of an outline that is nearest to a position.
struct OutlineFoot {
  double distance = 0.0;          ///< of the position from it, positive to the left of the outline [length]
  Vec2 tangent = Vec2::UnitX();   ///< of the outline there, in the direction in which it runs
  double curvature = 0.0;         ///< of the parallel curve through the position, > 0 to the left [1/length]
  double curvature_slope = 0.0;   ///< its derivative by the length of that curve [1/length²]
  double curvature_second = 0.0;  ///< Obstacle::curvature_second() of that curve [1/length³]
  double along = 0.0;             ///< Obstacle::along()
  bool beyond = false;            ///< the position is beyond an end of the outline
  double from_end = 0.0;          ///< of such a position from that end [length]
};

/// A curve in the plane that has a direction; the body stays to the left of it. It may be closed.
///
/// Must hold: the foot is the nearest of all places of the curve, and the curve is smooth there (C¹, its curvature
/// continuous but at single places) or a corner that points to the left.
class Outline {
 public:
  virtual ~Outline() = default;

  virtual OutlineFoot foot(const Vec2& position) const = 0;

  /// Obstacle::knots(), Obstacle::is_smooth() and Obstacle::period().
  virtual std::vector<double> knots() const { return {}; }
  virtual bool is_smooth() const { return false; }
  virtual double period() const { return 0.0; }

  /// The length of the outline from its beginning to a coordinate along it [length].
  virtual double length_to(double along) const = 0;

  /// Obstacle::curvature_rate_jumps().
  virtual std::vector<CurvatureRateJump> curvature_rate_jumps() const { return {}; }

  /// Its corners, all of which point to the left.
  virtual std::vector<SharpCorner> sharp_corners() const { return {}; }

  /// The greatest curvature to the left: a body of height h needs 1/κ > h/2 [1/length].
  virtual double sharpest_hollow() const = 0;

  /// A place far inside: behind the outline, and none of its ends is nearer. None of a closed one with the body inside.
  virtual std::optional<Vec2> core() const { return std::nullopt; }

  /// Points along it, for pictures; of one that goes on without end up to `reach` on either side [length].
  virtual std::vector<Vec2> points(double reach) const = 0;
};

/// An obstacle with such an outline for a body whose axis stays at a distance from it, half its height or 0:
///
///     g = d(r) − half_height + (1 − λ) retracted
///
/// with d the signed distance. Its surface is the curve parallel to the outline on which the axis would lie. With
/// `retracted` > 0 the surface begins so far behind its place, along all its normals, and comes to it with λ from 0 to
/// 1; the outline must have no radius as small, and no jump of the rate of its curvature [length].
std::shared_ptr<const Obstacle> obstacle(std::shared_ptr<const Outline> outline, double half_height = 0.0,
                                         double retracted = 0.0);

/// On which side of a closed outline the body stays.
enum class Keep { outside, inside };

/// The straight line through the point; the normal points to the body.
std::unique_ptr<Outline> half_plane_outline(const Vec2& point, const Vec2& normal);

std::unique_ptr<Outline> circle_outline(const Vec2& centre, double radius, Keep keep);

/// By half of its axes, the first of which has this angle from the x-axis [rad].
std::unique_ptr<Outline> ellipse_outline(const Vec2& centre, const Vec2& half_axes, double angle, Keep keep);

/// The C² cubic through the points by chord length, "not a knot" at the ends of an open one.
std::unique_ptr<Outline> curve_outline(std::vector<Vec2> points);
std::unique_ptr<Outline> closed_curve_outline(std::vector<Vec2> points, Keep keep);

/// Straight between the points, its corners rounded by arcs of this radius. With radius 0 all corners must point to the
/// left.
std::unique_ptr<Outline> polyline_outline(std::vector<Vec2> points, double corner_radius);
std::unique_ptr<Outline> closed_polyline_outline(std::vector<Vec2> points, double corner_radius, Keep keep);

/// The same with a radius at each point; those at the ends of an open outline count for nothing.
std::unique_ptr<Outline> polyline_outline(std::vector<Vec2> points, std::vector<double> radii);
std::unique_ptr<Outline> closed_polyline_outline(std::vector<Vec2> points, std::vector<double> radii, Keep keep);

/// A place behind an outline that faces it and is far from its line, but no farther than the line is long: of those
/// behind the middles of a polygon along it.
std::optional<Vec2> deepest_place(const Outline& outline, const std::vector<Vec2>& line);

/// Twice the area within a closed polygon, positive if it runs anticlockwise.
double doubled_area(const std::vector<Vec2>& polygon);

}  // namespace arcwall
