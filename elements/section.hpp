#pragma once

#include <optional>
#include <vector>

namespace arcwall {

/// Stores a quadrature point of a section.
struct SectionPoint {
  double z = 0.0;     ///< height above the axis [length]
  double area = 0.0;  ///< weight; negative in a hole [length²]
};

/// Stores properties of a cross section and its material, in consistent units.
struct Section {
  double E = 0.0;                         ///< Young's modulus [force/length²]
  double A = 0.0;                         ///< area [length²]
  double I = 0.0;                         ///< second moment of area for bending in the plane [length⁴]
  std::optional<double> height = {};      ///< along z [length]; required for contact on faces
  double G = 0.0;                         ///< shear modulus [force/length²]; required by shear-deformable theories
  double shear_area = 0.0;                ///< area times shear correction factor [length²]; likewise
  std::vector<SectionPoint> points = {};  ///< Σ f(z) area = ∫ f dA; required by the Essenburg theory

  double EA() const { return E * A; }
  double EI() const { return E * I; }
  double GA() const { return G * shear_area; }
};

/// Return five quadrature points, exact for polynomials in z up to degree 9.
std::vector<SectionPoint> rectangle_points(double width, double height);
std::vector<SectionPoint> circle_points(double radius);

/// Returns ten quadrature points of a circle with a hole.
std::vector<SectionPoint> tube_points(double radius, double thickness);

}  // namespace arcwall
