#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/verify/plain_outline.hpp"
#include "core/types.hpp"
#include "model/deck/deck.hpp"

namespace arcwall::verify {

/// A wall as its deck describes it, where it is at a λ, evaluated by formulas of its own: what tracing uses has no part
/// in it.
class PlainWall {
 public:
  /// At λ = 0; `wall` must outlive this.
  explicit PlainWall(const deck::Wall& wall);

  PlainWall at(double lambda) const {
    PlainWall moved = *this;
    if (wall_.motion) moved.progress_ = wall_.motion->progress.at(lambda);
    return moved;
  }

  /// The same wall, curved everywhere as it is so far along it.
  PlainWall curved_as_beside(double along) const {
    PlainWall other = *this;
    other.beside_ = along;
    return other;
  }

  /// Whether the curvature jumps within a distance along the wall: at the ends of a corner's arc it does.
  bool bends_anew(const Vec2& point, double within) const;

  const deck::Wall& deck() const { return wall_; }

  bool has_outline() const { return outline_ != nullptr; }

  /// +1 below the structure, −1 above it; +1 of an outline, which runs with the structure to its left.
  double side() const { return wall_.outline || wall_.side == Side::below ? 1.0 : -1.0; }

  /// How far the axis of a member that touches an outline is from it; 0 of a profile, which its faces touch.
  double kept_off(double half_height) const {
    return wall_.outline && wall_.contact_surface == deck::ContactSurface::face ? half_height : 0.0;
  }

  /// Whether there is a surface where a point is.
  bool faces(const Vec2& point) const;

  /// The surface's angle against the x-axis and its curvature where a point faces it.
  double slope_angle(const Vec2& point) const;
  double curvature(const Vec2& point) const;

  /// The x of a profile that a point faces, as the wall is at rest.
  double profile_x(const Vec2& point) const { return at_rest(point).x(); }

  /// Where the rate of a profile's curvature along it jumps, and by how much [1/length²].
  struct RateJump {
    double x, jump;
  };
  std::vector<RateJump> rate_jumps() const;

  /// Distance from the surface, positive outside: of a profile that across the wall's own x-axis, times the cosine of
  /// its slope.
  double gap(const Vec2& point) const;

  /// That of a face, or of an axis which is so far from the outside of its member; infinite where there is no surface.
  double gap_to(const Vec2& point, double half_height) const {
    return faces(point) ? gap(point) - kept_off(half_height) : infinity;
  }

  /// The slope of that by the point's place: the unit vector out of the wall; 0 where there is no surface.
  Vec2 normal(const Vec2& point) const;

  /// By how much the surface's angle changes for each length by which a point goes along it: κ/(1 − κ d) at the
  /// distance d, 0 where there is no surface [1/length].
  double turn(const Vec2& point) const;

  /// Where a member touches that has its face, or its axis, at a point.
  Vec2 touched_by(const Vec2& point, double half_height) const;

  /// Of what stands out of the wall, as far as its outline tells: diameters; ∞ of straight ones [length].
  double width() const;

  /// How far a point is, along the wall's own x-axis, from where a profile becomes vertical: a circle's ends; ∞ of
  /// others [length].
  double from_vertical(const Vec2& point) const;

  /// A place far inside an outline, as the wall is at rest.
  std::optional<Vec2> innermost() const { return outline_ ? outline_->innermost() : std::nullopt; }

  /// The point as the wall sees it, which moves and turns with λ.
  Vec2 at_rest(const Vec2& point) const;

  bool concerns(const std::string& member) const;

 private:
  struct Surface {
    double height, slope, second;
  };
  Surface surface(double x) const;  // of the wall at rest
  double turned() const { return wall_.motion ? progress_ * wall_.motion->rotation : 0.0; }

  deck::Wall wall_;
  double progress_ = 0.0;         // of its motion
  double beside_ = 0.0;           // by which curvatures are those of farther along
  std::vector<double> second_{};  // derivatives of a spline at its knots
  std::shared_ptr<const PlainOutline> outline_{};
};

/// The walls of each stage of a run; of a deck without stages there is one.
using WallsOfStages = std::vector<std::vector<PlainWall>>;

/// The walls where they are at a λ.
std::vector<PlainWall> walls_at(const std::vector<PlainWall>& walls, double lambda);

/// The walls of a deck, those with sharp hollow corners in their parts, which have one name.
std::vector<PlainWall> walls_of(const deck::Deck& deck);

/// The wall of that name, which there must be.
const PlainWall& wall_of(const std::vector<PlainWall>& walls, const std::string& name);

}  // namespace arcwall::verify
