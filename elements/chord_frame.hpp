#pragma once

#include <array>
#include <cmath>

#include "elements/slender_beam.hpp"

// What the unshearable elements share: their energy is a function of the chord's length l, the bend b = t2 − t1 and the
// skew σ = 3 (t1 + t2) of the end angles t_i against the chord (docs/theory.md, section 2.1). Here are the steps from
// displacements or places to these three, and back from their derivatives.
namespace arcwall {

/// An angle to within half a turn: rotations against the chord are small, whatever the winding number of both.
inline double within_half_a_turn(double angle) { return angle - 2.0 * pi * std::nearbyint(angle / (2.0 * pi)); }

/// The stress-free chord, and the angles of the axis' ends against it.
struct RestChord {
  Vec2 chord{};
  double length = 0.0, slope1 = 0.0, slope2 = 0.0;
};

/// The chord now, and what has changed since the stress-free state.
struct ChordMotion {
  double x, y, length;  // components and length of the chord
  double stretch;       // of its length
  double d1, d2;        // turn of each end against the chord
};

/// From displacements u1, w1, θ1, u2, w2, θ2: small ones keep their digits.
inline ChordMotion motion_of(const RestChord& rest, const double* u) {
  const double du = u[3] - u[0], dw = u[4] - u[1];
  const double x = rest.chord.x() + du, y = rest.chord.y() + dw;
  const double l = std::sqrt(x * x + y * y);
  const double turn = std::atan2(rest.chord.x() * y - rest.chord.y() * x, rest.chord.x() * x + rest.chord.y() * y);
  return {.x = x,
          .y = y,
          .length = l,
          .stretch = (du * (rest.chord.x() + x) + dw * (rest.chord.y() + y)) / (l + rest.length),
          .d1 = within_half_a_turn(u[2] - turn),
          .d2 = within_half_a_turn(u[5] - turn)};
}

/// From places.
inline ChordMotion motion_of(const RestChord& rest, const BeamEnds& ends) {
  const double l = ends.chord.norm(), direction = std::atan2(ends.chord.y(), ends.chord.x());
  return {.x = ends.chord.x(),
          .y = ends.chord.y(),
          .length = l,
          .stretch = l - rest.length,
          .d1 = within_half_a_turn(ends.angle1 - direction - rest.slope1),
          .d2 = within_half_a_turn(ends.angle2 - direction - rest.slope2)};
}

// A function of the bend b = t2 − t1 and the skew σ = 3 (t1 + t2) of an element, with its derivatives.
struct BendTerm {
  double value, b, s, bb, bs, ss;
};

// Shortening of the chord of an inextensible element, h/l − 1 = q + q² − Q to the fourth order. The angle against the
// chord is quadratic along the axis, θ = a + b x + c (x² − 1/12), |x| ≤ ½, with ∫ sin θ = 0, hence
//
//   a = b² σ/360 + σ³/22680,   c = σ − 6a,   q = b²/24 + σ²/360,
//   Q = b⁴/1920 + (11/60480 + 1/10800) b² σ² + (1/362880 + 1/680400) σ⁴                                      (1)
inline BendTerm shortening(double b, double s) {
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

// c of (1): the part of the curvature that varies along the element.
inline BendTerm variation(double b, double s) {
  return {.value = s - b * b * s / 60.0 - s * s * s / 3780.0,
          .b = -b * s / 30.0,
          .s = 1.0 - b * b / 60.0 - s * s / 1260.0,
          .bb = -s / 30.0,
          .bs = -b / 30.0,
          .ss = -s / 630.0};
}

/// First and second derivatives of an energy by l, b and σ.
struct ChordSlopes {
  double l, b, s;
};
struct ChordCurvatures {
  double ll, lb, ls, bb, bs, ss;
};

// Gradient and Hessian in the nodal unknowns follow with
//
//   ∂l = r,  ∂σ = 3 (e3 + e6) − 6 z/l,  ∂b = e6 − e3,  ∂²l = z zᵀ/l,  ∂²σ = 6 (r zᵀ + z rᵀ)/l²,
//   r = (−c, −s, 0, c, s, 0),  z = (s, −c, 0, −s, c, 0)  of the chord's direction (c, s)                 (2)
struct ChordDirection {
  double r[6], z[6];

  explicit ChordDirection(const ChordMotion& at) : ChordDirection(at.x / at.length, at.y / at.length) {}

 private:
  ChordDirection(double c, double s) : r{-c, -s, 0.0, c, s, 0.0}, z{s, -c, 0.0, -s, c, 0.0} {}
};

inline void nodal_forces(const ChordDirection& chord, double l, const ChordSlopes& U, double* f) {
  for (int i = 0; i < 6; ++i) f[i] = U.l * chord.r[i] - 6.0 * U.s / l * chord.z[i];
  f[2] += 3.0 * U.s - U.b;
  f[5] += 3.0 * U.s + U.b;
}

// K = Σ U_ab ∂a ∂bᵀ + U_l ∂²l + U_σ ∂²σ by (2), sorted by r, z and the two rotations (θ1: 3σ − b, θ2: 3σ + b).
inline void nodal_stiffness(const ChordDirection& chord, double l, const ChordSlopes& U, const ChordCurvatures& V,
                            double* K) {
  const auto& [r, z] = chord;
  const double rz = 6.0 * (U.s / l - V.ls) / l, zz = U.l / l + 36.0 * V.ss / (l * l);
  const double r1 = 3.0 * V.ls - V.lb, r2 = 3.0 * V.ls + V.lb;
  const double z1 = -6.0 * (3.0 * V.ss - V.bs) / l, z2 = -6.0 * (3.0 * V.ss + V.bs) / l;
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i) K[i + 6 * j] = V.ll * r[i] * r[j] + rz * (r[i] * z[j] + z[i] * r[j]) + zz * z[i] * z[j];
  for (int i = 0; i < 6; ++i) {
    K[i < 2 ? 2 + 6 * i : i + 12] += r1 * r[i] + z1 * z[i];
    K[5 + 6 * i] += r2 * r[i] + z2 * z[i];
  }
  K[2 + 6 * 2] += 9.0 * V.ss - 6.0 * V.bs + V.bb;
  K[5 + 6 * 5] += 9.0 * V.ss + 6.0 * V.bs + V.bb;
  K[5 + 6 * 2] += 9.0 * V.ss - V.bb;
}

/// ∂(l, b, σ)/∂q of BeamResponse, row by row.
Eigen::Matrix<double, 3, 4> chord_gradient(const ChordMotion& at);

/// Force and stiffness in q.
void respond_along(const ChordMotion& at, const ChordSlopes& U, const ChordCurvatures& V, BeamResponse& out);

/// The stress-free chord of a stretch, and its derivatives by S1 and S2.
RestChord rest_chord(const StretchReference& stretch);
std::array<RestChord, 2> rest_chord_rate(const StretchReference& stretch);

/// The axis of an element in the frame of its chord, with gradients by (l, b, σ).
struct BentAxis {
  static constexpr int terms = 5;

  double length = 0.0, EA = 0.0;
  Eigen::Matrix<double, terms, 1> angle = Eigen::Matrix<double, terms, 1>::Zero();  // coefficients of ξ − ½
  Eigen::Matrix<double, terms, 3> angle_gradient = Eigen::Matrix<double, terms, 3>::Zero();
  Vec2 force = Vec2::Zero();  // along the chord and across
  Eigen::Matrix<double, 2, 3> force_gradient = Eigen::Matrix<double, 2, 3>::Zero();
};

/// The place at ξ on such an axis.
BeamPlace place_on(const BentAxis& axis, const ChordMotion& at, double angle1, double xi);

}  // namespace arcwall
