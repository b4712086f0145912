#pragma once

#include <memory>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// On which side of its surface an obstacle is.
enum class Side {
  above,  ///< the structure stays below the surface
  below,  ///< the structure stays above it
};

/// Height of a surface and its derivatives at one x.
struct Height {
  double value, first, second, third;
};

/// The surface z = ψ(x) of a rigid obstacle.
class Profile {
 public:
  virtual ~Profile() = default;

  /// ψ, ψ′, ψ″, ψ‴; defined where covers(x).
  virtual Height at(double x) const = 0;

  /// Whether there is a surface at this x.
  virtual bool covers(double) const { return true; }
};

/// Gap between a point and a surface, with its derivatives by the point's x and z (∂²g/∂z² = 0):
///
///     g = ±(z − ψ(x)) / √(1 + ψ′(x)²)                                       + below, − above the structure
struct SurfaceGap {
  double value, x, z, xx, xz;
};

/// The same without second derivatives.
struct SurfaceSlope {
  double value, x, z;
};

/// Only where the profile covers the point.
SurfaceSlope surface_slope(const Profile& profile, Side side, const Vec2& point);
SurfaceGap surface_gap(const Profile& profile, Side side, const Vec2& point);

/// The unit vector along which the gap grows fastest.
Vec2 surface_normal(const Profile& profile, Side side, const Vec2& point);

std::unique_ptr<Profile> flat_profile(double z);
std::unique_ptr<Profile> line_profile(double z, double slope);                  ///< z + slope·x
std::unique_ptr<Profile> parabola_profile(const Vec2& apex, double curvature);  ///< z = apex + ½ curvature (x − apex)²

/// The upper arc for an obstacle below the structure, the lower one for an obstacle above it.
std::unique_ptr<Profile> circle_profile(const Vec2& centre, double radius, Side side);

/// C² cubic through the points; x strictly increasing.
std::unique_ptr<Profile> spline_profile(std::vector<double> x, std::vector<double> z);

}  // namespace arcwall
