#pragma once

#include "core/types.hpp"
#include "elements/element.hpp"

namespace arcwall {

/// Strain measures of a bar with stress-free length L and current length l.
enum class TrussStrain {
  green,        ///< (l² − L²) / (2L²)
  engineering,  ///< (l − L) / L
  log,          ///< ln(l / L)
};

/// Evaluates a bar with axial force only: U = ½ EA L ε² [force·length]. Unknowns: u1, w1, u2, w2.
class Truss final : public Element {
 public:
  Truss(const Vec2& chord, double EA, TrussStrain strain)
      : chord_(chord), length_(chord.norm()), EA_(EA), strain_(strain) {}

  int unknown_count() const override { return 4; }
  double evaluate(const double* u, double* f, double* K) const override { return evaluate(u, 0.0, f, K, nullptr); }

  /// Evaluates the bar with stress-free strain e: U = ½ EA L (ε − e)². Writes ∂f/∂e to `f_strain` unless null.
  double evaluate(const double* u, double e, double* f, double* K, double* f_strain) const;

 private:
  Vec2 chord_;
  double length_;
  double EA_;
  TrussStrain strain_;
};

}  // namespace arcwall
