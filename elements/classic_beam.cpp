#include "elements/classic_beam.hpp"

#include <cmath>

namespace arcwall {

namespace {

constexpr double two_pi = 2.0 * pi;

// An angle to within half a turn: rotations against the chord are small, whatever the winding number of both.
double within_half_a_turn(double angle) { return angle - two_pi * std::nearbyint(angle / two_pi); }

// Mean of ½ w′² over the element for Hermite's cubic with end slopes t1, t2.
double mean_half_square(double t1, double t2) { return (2.0 * t1 * t1 - t1 * t2 + 2.0 * t2 * t2) / 30.0; }

// Derivatives of the energy in the natural deformations: chord length l and end slopes t1, t2.
struct Natural {
  double U;
  double l, t1, t2;                             // first
  double l_l, l_t1, l_t2, t1_t1, t1_t2, t2_t2;  // second
};

}  // namespace

ClassicBeam::ClassicBeam(const BeamReference& reference, double EA, double EI)
    : chord_(reference.chord),
      chord_length_(reference.chord.norm()),
      length_(reference.length),
      t1_(reference.slope1),
      t2_(reference.slope2),
      q_(mean_half_square(reference.slope1, reference.slope2)),
      EA_(EA),
      EI_(EI) {}

// With the chord l at angle β, rotations t_i = θ_i − (β − β₀) + t_i⁰ against it, d_i = t_i − t_i⁰ and
// q = (2 t1² − t1 t2 + 2 t2²)/30, the mean of ½ w′²:
//
//   U = ½ EA h ε² + (2EI/h) (d1² + d1 d2 + d2²) − c (d1 + d2)² q / l²,     c = 36 EI² / (EA h)         (1)
//   ε = [l (1 + q) − l₀ (1 + q₀)] / h                                                                  (2)
//
// The last term of (1) is the tilt of the chord where the stretch varies along the element; without it and the factor
// 1 + q of (2) the order drops from 4 to 2. Gradient and Hessian in the nodal unknowns follow with
//
//   ∂l = r,  ∂β = z/l,  ∂²l = z zᵀ/l,  ∂²β = −(r zᵀ + z rᵀ)/l²,   r = (−c, −s, 0, c, s, 0),  z = (s, −c, 0, −s, c, 0)
//   (3)
double ClassicBeam::evaluate(const double* u, double* f, double* K) const {
  const double du = u[3] - u[0], dw = u[4] - u[1];
  const double x = chord_.x() + du, y = chord_.y() + dw;
  const double l = std::sqrt(x * x + y * y);
  const double turn = std::atan2(chord_.x() * y - chord_.y() * x, chord_.x() * x + chord_.y() * y);  // β − β₀
  const double d1 = within_half_a_turn(u[2] - turn), d2 = within_half_a_turn(u[5] - turn);
  const double t1 = t1_ + d1, t2 = t2_ + d2, s = d1 + d2, h = length_;
  const double q = mean_half_square(t1, t2), q1 = (4.0 * t1 - t2) / 30.0, q2 = (4.0 * t2 - t1) / 30.0;
  constexpr double q11 = 4.0 / 30.0, q12 = -1.0 / 30.0;

  // l − l₀ without cancellation
  const double stretch = (du * (chord_.x() + x) + dw * (chord_.y() + y)) / (l + chord_length_);
  const double strain = (stretch * (1.0 + q) + chord_length_ * (q - q_)) / h;
  const double N = EA_ * strain, b = 2.0 * EI_ / h;
  const double tilt = 36.0 * EI_ * EI_ / (EA_ * h * l * l);  // c / l²

  Natural n{};
  n.U = 0.5 * h * N * strain + b * (d1 * d1 + d1 * d2 + d2 * d2) - tilt * s * s * q;
  if (f == nullptr && K == nullptr) return n.U;
  n.l = N * (1.0 + q) + 2.0 * tilt * s * s * q / l;
  n.t1 = N * l * q1 + b * (2.0 * d1 + d2) - tilt * s * (2.0 * q + s * q1);
  n.t2 = N * l * q2 + b * (d1 + 2.0 * d2) - tilt * s * (2.0 * q + s * q2);

  const double c = x / l, sn = y / l;
  const double r[6] = {-c, -sn, 0.0, c, sn, 0.0}, z[6] = {sn, -c, 0.0, -sn, c, 0.0};
  const double Q = (n.t1 + n.t2) / l;  // force across the chord
  if (f != nullptr) {
    for (int i = 0; i < 6; ++i) f[i] = n.l * r[i] - Q * z[i];
    f[2] += n.t1;
    f[5] += n.t2;
  }
  if (K == nullptr) return n.U;

  const double a = EA_ / h;
  n.l_l = a * (1.0 + q) * (1.0 + q) - 6.0 * tilt * s * s * q / (l * l);
  n.l_t1 = a * l * q1 * (1.0 + q) + N * q1 + 2.0 * tilt * s * (2.0 * q + s * q1) / l;
  n.l_t2 = a * l * q2 * (1.0 + q) + N * q2 + 2.0 * tilt * s * (2.0 * q + s * q2) / l;
  n.t1_t1 = a * l * l * q1 * q1 + N * l * q11 + 2.0 * b - tilt * (2.0 * q + 4.0 * s * q1 + s * s * q11);
  n.t2_t2 = a * l * l * q2 * q2 + N * l * q11 + 2.0 * b - tilt * (2.0 * q + 4.0 * s * q2 + s * s * q11);
  n.t1_t2 = a * l * l * q1 * q2 + N * l * q12 + b - tilt * (2.0 * q + 2.0 * s * (q1 + q2) + s * s * q12);

  // With t_i = θ_i − β: rows of the natural deformations are r, e3 − z/l and e6 − z/l. Written out in r, z, e3, e6.
  const double rz = -(n.l_t1 + n.l_t2) / l + Q / l;
  const double zz = (n.t1_t1 + 2.0 * n.t1_t2 + n.t2_t2) / (l * l) + n.l / l;
  const double z3 = -(n.t1_t1 + n.t1_t2) / l, z6 = -(n.t1_t2 + n.t2_t2) / l;
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i)
      K[i + 6 * j] = n.l_l * r[i] * r[j] + rz * (r[i] * z[j] + z[i] * r[j]) + zz * z[i] * z[j];
  for (int i = 0; i < 6; ++i) {
    K[i < 2 ? 2 + 6 * i : i + 12] += n.l_t1 * r[i] + z3 * z[i];
    K[5 + 6 * i] += n.l_t2 * r[i] + z6 * z[i];
  }
  K[2 + 6 * 2] += n.t1_t1;
  K[5 + 6 * 5] += n.t2_t2;
  K[5 + 6 * 2] += n.t1_t2;
  return n.U;
}

}  // namespace arcwall
