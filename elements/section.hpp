#pragma once

#include <optional>
#include <vector>

namespace arcwall {

/// A point of a quadrature over a section.
struct SectionPoint {
  double z = 0.0;     ///< height above the axis [length]
  double area = 0.0;  ///< weight; negative in a hole [length²]
};

/// What the theories need of a cross section and its material, in consistent units.
struct Section {
  double E = 0.0;                     ///< Young's modulus [force/length²]
  double A = 0.0;                     ///< area [length²]
  double I = 0.0;                     ///< second moment of area for bending in the plane [length⁴]
  std::optional<double> height = {};  ///< along z [length]; needed where contact acts on faces
  double G = 0.0;           ///< shear modulus [force/length²]; needed by the theories that are flexible in shear
  double shear_area = 0.0;  ///< area times the shear correction [length²]; likewise
  std::vector<SectionPoint> points = {};  ///< Σ f(z) area = ∫ f dA; needed by the theory that integrates stresses

  double EA() const { return E * A; }
  double EI() const { return E * I; }
  double GA() const { return G * shear_area; }
};

/// Five points, exact for polynomials in z to degree 9.
std::vector<SectionPoint> rectangle_points(double width, double height);
std::vector<SectionPoint> circle_points(double radius);

/// A circle less its hole: ten points.
std::vector<SectionPoint> tube_points(double radius, double thickness);

}  // namespace arcwall
