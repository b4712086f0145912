#pragma once

#include "elements/driven.hpp"
#include "elements/slender_beam.hpp"

namespace arcwall {

/// What a section wants to be without force, beyond its stress-free state: a strain and a curvature, both by
/// stress-free length, positive where it turns to the left. Temperatures make them, which λ may drive.
struct ThermalStrain {
  Driven strain{};     ///< [-]
  Driven curvature{};  ///< [1/length]

  bool is_zero() const { return strain.is_zero() && curvature.is_zero(); }
  ThermalStrain& operator+=(const ThermalStrain& other) {
    strain += other.strain;
    curvature += other.curvature;
    return *this;
  }
  bool operator==(const ThermalStrain&) const = default;
};

/// A stretch of a slender beam as it would lie without force at λ: s = 1 + strain times as long, and bent. On it the
/// laws N = EA (ds/dS − 1 − e) and M = EI (dθ/dS − κ₀ − κ_T) by stress-free length are those of a beam without heat
/// whose stiffnesses are s EA and s EI.
struct HeatedStretch {
  StretchReference reference{};  ///< with its rates by S1 and S2
  StretchReference by_lambda{};  ///< the same with the rates by λ in the first places, 0 in the second
  double stiffer = 1.0;          ///< s
  double stiffer_rate = 0.0;     ///< ds/dλ
};
HeatedStretch heated(const StretchReference& cold, const ThermalStrain& thermal, double lambda);

}  // namespace arcwall
