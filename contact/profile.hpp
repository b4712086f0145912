#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "contact/obstacle.hpp"

namespace arcwall {

/// Height of a surface and its derivatives at one x.
struct Height {
  double value, first, second, third, fourth;
};

/// The surface z = ψ(x) of a rigid obstacle that stands still.
class Profile {
 public:
  virtual ~Profile() = default;

  /// ψ, ψ′, ψ″, ψ‴, ψ⁗; defined where covers(x). Where ψ‴ jumps ψ⁗ leaves the jump out.
  virtual Height at(double x) const = 0;

  /// The arc length of the surface from a place of it to this x.
  virtual double length_to(double x) const = 0;

  /// Whether there is a surface at this x.
  virtual bool covers(double) const { return true; }

  /// Obstacle::knots() of a surface whose coordinate is x.
  virtual std::vector<double> knots() const { return {}; }

  /// Obstacle::is_smooth().
  virtual bool is_smooth() const { return false; }

  /// Where ψ‴ jumps, by how much, and up to which distance it goes over.
  struct Jump {
    double x, of_third, half_width;
  };
  virtual std::vector<Jump> jumps() const { return {}; }

  /// From which x to which the surface is drawn.
  virtual std::pair<double, double> extent() const { return {-infinity, infinity}; }
};

/// An obstacle with such a surface, which runs with x and is faced from straight above or below:
///
///     g = ±(z − ψ(x)) / √(1 + ψ′(x)²)                                       + below, − above the structure
std::shared_ptr<const Obstacle> obstacle(std::shared_ptr<const Profile> profile, Side side);

std::unique_ptr<Profile> flat_profile(double z);
std::unique_ptr<Profile> line_profile(double z, double slope);                  ///< z + slope·x
std::unique_ptr<Profile> parabola_profile(const Vec2& apex, double curvature);  ///< z = apex + ½ curvature (x − apex)²

/// The upper arc for an obstacle below the structure, the lower one for an obstacle above it.
std::unique_ptr<Profile> circle_profile(const Vec2& centre, double radius, Side side);

/// C² cubic through the points; x strictly increasing.
std::unique_ptr<Profile> spline_profile(std::vector<double> x, std::vector<double> z);

}  // namespace arcwall
