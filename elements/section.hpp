#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace arcwall {

/// Stores a quadrature point of a section.
struct SectionPoint {
  double z = 0.0;     ///< height above the axis [length]
  double area = 0.0;  ///< weight; negative in a hole [length²]
};

/// Stores the sizes of a section that varies along a member.
struct SectionSizes {
  double A = 0.0;           ///< [length²]
  double I = 0.0;           ///< [length⁴]
  double height = 0.0;      ///< 0: unknown [length]
  double shear_area = 0.0;  ///< [length²]
};

/// The sizes of a section by the fraction of the member's length: polynomials of degree 4 at most in each piece.
class SectionTaper {
 public:
  /// `breaks`: ends of the pieces, ascending from 0 to 1. `sizes`: inside them, at a fraction.
  SectionTaper(std::vector<double> breaks, const std::function<SectionSizes(double)>& sizes);

  /// Returns the sizes, or a derivative of them by the fraction.
  SectionSizes at(double fraction, int derivative = 0) const;

 private:
  using Polynomial = std::array<double, 5>;
  struct Piece {
    double from, to;
    Polynomial A, I, height, shear_area;
  };
  std::vector<Piece> pieces_;
};

/// Stores properties of a cross section and its material, in consistent units.
///
/// Of a section with a taper A, I, height and shear_area are those at the middle of the member.
struct Section {
  double E = 0.0;                         ///< Young's modulus [force/length²]
  double A = 0.0;                         ///< area [length²]
  double I = 0.0;                         ///< second moment of area for bending in the plane [length⁴]
  std::optional<double> height = {};      ///< along z [length]; required for contact on faces
  double G = 0.0;                         ///< shear modulus [force/length²]; required by shear-deformable theories
  double shear_area = 0.0;                ///< area times shear correction factor [length²]; likewise
  std::vector<SectionPoint> points = {};  ///< Σ f(z) area = ∫ f dA; required by the Essenburg theory

  std::shared_ptr<const SectionTaper> taper = {};  ///< null: the same all along the member

  /// Returns the section at a fraction of the member's length, without a taper.
  Section at(double fraction) const;

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
