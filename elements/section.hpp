#pragma once

#include <optional>

namespace arcwall {

/// What the theories need of a cross section and its material, in consistent units.
struct Section {
  double E = 0.0;                     ///< Young's modulus [force/length²]
  double A = 0.0;                     ///< area [length²]
  double I = 0.0;                     ///< second moment of area for bending in the plane [length⁴]
  std::optional<double> height = {};  ///< along z [length]; needed where contact acts on faces
  double G = 0.0;           ///< shear modulus [force/length²]; needed by the theories that are flexible in shear
  double shear_area = 0.0;  ///< area times the shear correction [length²]; likewise

  double EA() const { return E * A; }
  double EI() const { return E * I; }
  double GA() const { return G * shear_area; }
};

}  // namespace arcwall
