#include "elements/section.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "core/types.hpp"

namespace arcwall {

std::vector<SectionPoint> rectangle_points(double width, double height) {
  using Gauss = boost::math::quadrature::gauss<double, 5>;
  const double half = 0.5 * height;
  std::vector<SectionPoint> points;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    const double z = half * Gauss::abscissa()[i], area = width * half * Gauss::weights()[i];
    points.push_back({.z = z, .area = area});
    if (z != 0.0) points.push_back({.z = -z, .area = area});
  }
  return points;
}

// ∫ f(z) 2 √(r² − z²) dz = Σ (2π r²/6) sin²(iπ/6) f(r cos(iπ/6)), the Gauss rule for this weight.
std::vector<SectionPoint> circle_points(double radius) {
  constexpr int count = 5;
  std::vector<SectionPoint> points;
  for (int i = 1; i <= count; ++i) {
    const double angle = i * pi / (count + 1), sine = std::sin(angle);
    points.push_back({.z = radius * std::cos(angle), .area = 2.0 * pi * radius * radius / (count + 1) * sine * sine});
  }
  return points;
}

std::vector<SectionPoint> tube_points(double radius, double thickness) {
  std::vector<SectionPoint> points = circle_points(radius);
  for (const SectionPoint& hole : circle_points(radius - thickness))
    points.push_back({.z = hole.z, .area = -hole.area});
  return points;
}

}  // namespace arcwall
