#include "elements/truss.hpp"

#include <cmath>

namespace arcwall {

namespace {

// A strain as a function of the squared length a = l²: value, first and second derivative.
struct Strain {
  double value, first, second;
};

// `growth` is l² − L², given apart so that small strains keep their digits.
Strain strain_of(TrussStrain measure, double growth, double L) {
  const double a = L * L + growth, l = std::sqrt(a);
  switch (measure) {
    case TrussStrain::green:
      return {0.5 * growth / (L * L), 0.5 / (L * L), 0.0};
    case TrussStrain::engineering:
      return {growth / (L * (l + L)), 0.5 / (L * l), -0.25 / (L * l * a)};
    case TrussStrain::log:
      return {0.5 * std::log1p(growth / (L * L)), 0.5 / a, -0.5 / (a * a)};
  }
  return {};
}

}  // namespace

// With d = (−Δ, Δ) the current chord in the nodal unknowns, ∂a = 2d and ∂²a = 2D, D = [I −I; −I I]:
//
//   f = EA L ε ε′ 2d,     K = EA L [(ε′² + ε ε″) 4 d dᵀ + ε ε′ 2 D]                                     (1)
double Truss::evaluate(const double* u, double free, double* f, double* K, double* f_strain) const {
  const double du = u[2] - u[0], dw = u[3] - u[1];
  const Vec2 chord = chord_ + Vec2(du, dw);
  const double growth = du * (chord_.x() + chord.x()) + dw * (chord_.y() + chord.y());
  Strain e = strain_of(strain_, growth, length_);
  e.value -= free;
  const double d[4] = {-chord.x(), -chord.y(), chord.x(), chord.y()};
  const double slope = 2.0 * EA_ * length_ * e.value * e.first;
  const double curvature = 4.0 * EA_ * length_ * (e.first * e.first + e.value * e.second);
  if (f != nullptr)
    for (int i = 0; i < 4; ++i) f[i] = slope * d[i];
  if (f_strain != nullptr)
    for (int i = 0; i < 4; ++i) f_strain[i] = -2.0 * EA_ * length_ * e.first * d[i];
  if (K != nullptr)
    for (int j = 0; j < 4; ++j)
      for (int i = j; i < 4; ++i)
        K[i + 4 * j] = curvature * d[i] * d[j] + ((i - j) % 2 == 0 ? (i == j ? slope : -slope) : 0.0);
  return 0.5 * EA_ * length_ * e.value * e.value;
}

}  // namespace arcwall
