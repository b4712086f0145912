#include "elements/classic_beam.hpp"

#include <cmath>

namespace arcwall {

namespace {

constexpr double two_pi = 2.0 * pi;

// An angle to within half a turn: rotations against the chord are small, whatever the winding number of both.
double within_half_a_turn(double angle) { return angle - two_pi * std::nearbyint(angle / two_pi); }

// A function of the bend b = t2 − t1 and the skew σ = 3 (t1 + t2) of an element, with its derivatives.
struct Shape {
  double value, b, s, bb, bs, ss;
};

// Shortening of the chord of an inextensible element, h/l − 1 = q + q² − Q to the fourth order. The angle against the
// chord is quadratic along the axis, θ = a + b x + c (x² − 1/12), |x| ≤ ½, with ∫ sin θ = 0, hence
//
//   a = b² σ/360 + σ³/22680,   c = σ − 6a,   q = b²/24 + σ²/360,
//   Q = b⁴/1920 + (11/60480 + 1/10800) b² σ² + (1/362880 + 1/680400) σ⁴                                      (4)
Shape shortening(double b, double s) {
  constexpr double Q1 = 1.0 / 1920.0, Q2 = 11.0 / 60480.0 + 1.0 / 10800.0, Q3 = 1.0 / 362880.0 + 1.0 / 680400.0;
  constexpr double q_bb = 1.0 / 12.0, q_ss = 1.0 / 180.0;
  const double q = b * b / 24.0 + s * s / 360.0, q_b = q_bb * b, q_s = q_ss * s, f = 1.0 + 2.0 * q;
  return {.value = q + q * q - (Q1 * b * b + Q2 * s * s) * b * b - Q3 * s * s * s * s,
          .b = f * q_b - (4.0 * Q1 * b * b + 2.0 * Q2 * s * s) * b,
          .s = f * q_s - (2.0 * Q2 * b * b + 4.0 * Q3 * s * s) * s,
          .bb = f * q_bb + 2.0 * q_b * q_b - 12.0 * Q1 * b * b - 2.0 * Q2 * s * s,
          .bs = 2.0 * q_b * q_s - 4.0 * Q2 * b * s,
          .ss = f * q_ss + 2.0 * q_s * q_s - 2.0 * Q2 * b * b - 12.0 * Q3 * s * s};
}

// c of (4): the part of the curvature that varies along the element.
Shape variation(double b, double s) {
  return {.value = s - b * b * s / 60.0 - s * s * s / 3780.0,
          .b = -b * s / 30.0,
          .s = 1.0 - b * b / 60.0 - s * s / 1260.0,
          .bb = -s / 30.0,
          .bs = -b / 30.0,
          .ss = -s / 630.0};
}

// The factor of the tilt term of (1), q/(l² + 24 q EI/EA), with its derivatives by the chord and by q.
struct TiltFactor {
  double value, l, q, ll, lq, qq;
};

TiltFactor tilt_factor(double l, double q, double flexibility) {
  const double c = 24.0 * flexibility, D = l * l + c * q;
  return {.value = q / D,
          .l = -2.0 * l * q / (D * D),
          .q = l * l / (D * D),
          .ll = 2.0 * q * (3.0 * l * l - c * q) / (D * D * D),
          .lq = 2.0 * l * (c * q - l * l) / (D * D * D),
          .qq = -2.0 * c * l * l / (D * D * D)};
}

}  // namespace

ClassicBeam::ClassicBeam(const BeamReference& reference, double EA, double EI)
    : chord_(reference.chord),
      chord_length_(reference.chord.norm()),
      length_(reference.length),
      b_(reference.slope2 - reference.slope1),
      s_(3.0 * (reference.slope1 + reference.slope2)),
      c_(variation(b_, s_).value),
      shortening_(shortening(b_, s_).value),
      EA_(EA),
      EI_(EI) {}

// With the chord l at angle β, end slopes t_i = θ_i − (β − β₀) + t_i⁰ against it, b, σ and c as in (4):
//
//   U = ½ EA h ε² + EI/(2h) [(b − b⁰)² + (c − c⁰)²/3] − 4 EI² (σ − σ⁰)² q / [EA h (l² + 24 q EI/EA)]   (1)
//   ε = [l (1 + q + q² − Q) − l₀ (1 + q⁰ + …)] / h                                                     (2)
//
// The last term of (1) is the tilt of the chord where the stretch varies along the element; without it and the factor
// of (2) the order drops from 4 to 2. Gradient and Hessian in the nodal unknowns follow with
//
//   ∂l = r,  ∂σ = 3 (e3 + e6) − 6 z/l,  ∂b = e6 − e3,  ∂²l = z zᵀ/l,  ∂²σ = 6 (r zᵀ + z rᵀ)/l²,
//   r = (−c, −s, 0, c, s, 0),  z = (s, −c, 0, −s, c, 0)  of the chord's direction (c, s)                 (3)
double ClassicBeam::evaluate(const double* u, double* f, double* K) const {
  const double du = u[3] - u[0], dw = u[4] - u[1];
  const double x = chord_.x() + du, y = chord_.y() + dw;
  const double l = std::sqrt(x * x + y * y), h = length_;
  const double turn = std::atan2(chord_.x() * y - chord_.y() * x, chord_.x() * x + chord_.y() * y);  // β − β₀
  const double d1 = within_half_a_turn(u[2] - turn), d2 = within_half_a_turn(u[5] - turn);
  const double db = d2 - d1, ds = 3.0 * (d1 + d2), b = b_ + db, s = s_ + ds;

  const Shape p = shortening(b, s), v = variation(b, s);
  const double stretch = (du * (chord_.x() + x) + dw * (chord_.y() + y)) / (l + chord_length_);  // l − l₀
  const double N = EA_ * (stretch * (1.0 + p.value) + chord_length_ * (p.value - shortening_)) / h;
  const double bending = EI_ / h, dc = v.value - c_;
  const double tilt = 4.0 * EI_ * EI_ / (EA_ * h);
  const double q = b * b / 24.0 + s * s / 360.0, q_b = b / 12.0, q_s = s / 180.0;
  const TiltFactor g = tilt_factor(l, q, EI_ / EA_);

  const double U = 0.5 * N * N * h / EA_ + 0.5 * bending * (db * db + dc * dc / 3.0) - tilt * ds * ds * g.value;
  if (f == nullptr && K == nullptr) return U;
  const double U_l = N * (1.0 + p.value) - tilt * ds * ds * g.l;
  const double U_b = N * l * p.b + bending * (db + dc * v.b / 3.0) - tilt * ds * ds * g.q * q_b;
  const double U_s = N * l * p.s + bending * dc * v.s / 3.0 - tilt * ds * (2.0 * g.value + ds * g.q * q_s);

  const double cosine = x / l, sine = y / l;
  const double r[6] = {-cosine, -sine, 0.0, cosine, sine, 0.0}, z[6] = {sine, -cosine, 0.0, -sine, cosine, 0.0};
  if (f != nullptr) {
    for (int i = 0; i < 6; ++i) f[i] = U_l * r[i] - 6.0 * U_s / l * z[i];
    f[2] += 3.0 * U_s - U_b;
    f[5] += 3.0 * U_s + U_b;
  }
  if (K == nullptr) return U;

  const double a = EA_ / h, m = 1.0 + p.value;
  const double U_ll = a * m * m - tilt * ds * ds * g.ll;
  const double U_lb = (a * l * m + N) * p.b - tilt * ds * ds * g.lq * q_b;
  const double U_ls = (a * l * m + N) * p.s - tilt * ds * (2.0 * g.l + ds * g.lq * q_s);
  const double U_bb = a * l * l * p.b * p.b + N * l * p.bb + bending * (1.0 + (v.b * v.b + dc * v.bb) / 3.0) -
                      tilt * ds * ds * (g.qq * q_b * q_b + g.q / 12.0);
  const double U_bs = a * l * l * p.b * p.s + N * l * p.bs + bending * (v.b * v.s + dc * v.bs) / 3.0 -
                      tilt * ds * (2.0 * g.q * q_b + ds * g.qq * q_b * q_s);
  const double U_ss = a * l * l * p.s * p.s + N * l * p.ss + bending * (v.s * v.s + dc * v.ss) / 3.0 -
                      tilt * (2.0 * g.value + 4.0 * ds * g.q * q_s + ds * ds * (g.qq * q_s * q_s + g.q / 180.0));

  // K = Σ U_ab ∂a ∂bᵀ + U_l ∂²l + U_s ∂²σ by (3), sorted by r, z and the two rotations (θ1: 3σ − b, θ2: 3σ + b).
  const double rz = 6.0 * (U_s / l - U_ls) / l, zz = U_l / l + 36.0 * U_ss / (l * l);
  const double r1 = 3.0 * U_ls - U_lb, r2 = 3.0 * U_ls + U_lb;
  const double z1 = -6.0 * (3.0 * U_ss - U_bs) / l, z2 = -6.0 * (3.0 * U_ss + U_bs) / l;
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i) K[i + 6 * j] = U_ll * r[i] * r[j] + rz * (r[i] * z[j] + z[i] * r[j]) + zz * z[i] * z[j];
  for (int i = 0; i < 6; ++i) {
    K[i < 2 ? 2 + 6 * i : i + 12] += r1 * r[i] + z1 * z[i];
    K[5 + 6 * i] += r2 * r[i] + z2 * z[i];
  }
  K[2 + 6 * 2] += 9.0 * U_ss - 6.0 * U_bs + U_bb;
  K[5 + 6 * 5] += 9.0 * U_ss + 6.0 * U_bs + U_bb;
  K[5 + 6 * 2] += 9.0 * U_ss - U_bb;
  return U;
}

}  // namespace arcwall
