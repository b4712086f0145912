#pragma once

#include <array>
#include <cmath>

#include "core/lanes.hpp"
#include "elements/slender_beam.hpp"

// What the unshearable elements share: their energy is a function of the chord's length l, the bend b = t2 − t1 and the
// skew σ = 3 (t1 + t2) of the end angles t_i against the chord (docs/theory.md, section 2.1). Here are the steps from
// displacements or places to these three, and back from their derivatives.
namespace arcwall {

/// An angle to within half a turn: rotations against the chord are small, whatever the winding number of both.
template <class Real>
ARCWALL_IN_PLACE Real within_half_a_turn(const Real& angle) {
  const Real turns = angle * (0.5 / pi);
  return angle - 2.0 * pi * nearest_whole(turns);
}

/// The stress-free chord, and the angles of the axis' ends against it.
struct RestChord {
  Vec2 chord{};
  double length = 0.0, slope1 = 0.0, slope2 = 0.0;
};

/// The chord now, and what has changed since the stress-free state.
template <class Real>
struct BasicChordMotion {
  Real x, y, length;  // components and length of the chord
  Real stretch;       // of its length
  Real d1, d2;        // turn of each end against the chord
};
using ChordMotion = BasicChordMotion<double>;

/// From displacements u1, w1, θ1, u2, w2, θ2, where (X, Y) of the length L is the stress-free chord: small ones keep
/// their digits.
template <class Real>
ARCWALL_IN_PLACE BasicChordMotion<Real> motion_of(const Real& X, const Real& Y, const Real& L, const Real* u) {
  const Real du = u[3] - u[0], dw = u[4] - u[1];
  const Real x = X + du, y = Y + dw;
  const Real l = square_root(x * x + y * y);
  const Real turn = arc_tangent(X * y - Y * x, X * x + Y * y);
  return {.x = x,
          .y = y,
          .length = l,
          .stretch = (du * (X + x) + dw * (Y + y)) / (l + L),
          .d1 = within_half_a_turn(u[2] - turn),
          .d2 = within_half_a_turn(u[5] - turn)};
}

inline ChordMotion motion_of(const RestChord& rest, const double* u) {
  return motion_of(rest.chord.x(), rest.chord.y(), rest.length, u);
}

/// From places: the chord (x, y) and the angles of the tangents now, and what the chord's length and its angles against
/// the tangents were.
template <class Real>
ARCWALL_IN_PLACE BasicChordMotion<Real> motion_between(const Real& x, const Real& y, const Real& angle1,
                                                       const Real& angle2, const Real& rest_length,
                                                       const Real& rest_slope1, const Real& rest_slope2) {
  const Real l = square_root(x * x + y * y), direction = arc_tangent(y, x);
  return {.x = x,
          .y = y,
          .length = l,
          .stretch = l - rest_length,
          .d1 = within_half_a_turn(angle1 - direction - rest_slope1),
          .d2 = within_half_a_turn(angle2 - direction - rest_slope2)};
}

inline ChordMotion motion_of(const RestChord& rest, const BeamEnds& ends) {
  return motion_between(ends.chord.x(), ends.chord.y(), ends.angle1, ends.angle2, rest.length, rest.slope1,
                        rest.slope2);
}

// A function of the bend b = t2 − t1 and the skew σ = 3 (t1 + t2) of an element, with its derivatives.
template <class Real>
struct BasicBendTerm {
  Real value, b, s, bb, bs, ss;
};
using BendTerm = BasicBendTerm<double>;

// Shortening of the chord of an inextensible element, h/l − 1 = q + q² − Q to the fourth order. The angle against the
// chord is quadratic along the axis, θ = a + b x + c (x² − 1/12), |x| ≤ ½, with ∫ sin θ = 0, hence
//
//   a = b² σ/360 + σ³/22680,   c = σ − 6a,   q = b²/24 + σ²/360,
//   Q = b⁴/1920 + (11/60480 + 1/10800) b² σ² + (1/362880 + 1/680400) σ⁴                                      (1)
template <class Real>
ARCWALL_IN_PLACE BasicBendTerm<Real> shortening(const Real& b, const Real& s) {
  constexpr double Q1 = 1.0 / 1920.0, Q2 = 11.0 / 60480.0 + 1.0 / 10800.0, Q3 = 1.0 / 362880.0 + 1.0 / 680400.0;
  constexpr double q_bb = 1.0 / 12.0, q_ss = 1.0 / 180.0;
  const Real b2 = b * b, s2 = s * s, q = b2 * (0.5 * q_bb) + s2 * (0.5 * q_ss);
  const Real q_b = q_bb * b, q_s = q_ss * s, f = 1.0 + 2.0 * q;
  return {.value = q + q * q - (Q1 * b2 + Q2 * s2) * b2 - Q3 * (s2 * s2),
          .b = f * q_b - (4.0 * Q1 * b2 + 2.0 * Q2 * s2) * b,
          .s = f * q_s - (2.0 * Q2 * b2 + 4.0 * Q3 * s2) * s,
          .bb = f * q_bb + 2.0 * (q_b * q_b) - 12.0 * Q1 * b2 - 2.0 * Q2 * s2,
          .bs = 2.0 * (q_b * q_s) - 4.0 * Q2 * (b * s),
          .ss = f * q_ss + 2.0 * (q_s * q_s) - 2.0 * Q2 * b2 - 12.0 * Q3 * s2};
}

// c of (1): the part of the curvature that varies along the element.
template <class Real>
ARCWALL_IN_PLACE BasicBendTerm<Real> variation(const Real& b, const Real& s) {
  const Real b2 = b * b, s2 = s * s;
  return {.value = s * (1.0 - b2 * (1.0 / 60.0) - s2 * (1.0 / 3780.0)),
          .b = (b * s) * (-1.0 / 30.0),
          .s = 1.0 - b2 * (1.0 / 60.0) - s2 * (1.0 / 1260.0),
          .bb = s * (-1.0 / 30.0),
          .bs = b * (-1.0 / 30.0),
          .ss = s * (-1.0 / 630.0)};
}

/// First and second derivatives of an energy by l, b and σ.
template <class Real>
struct BasicChordSlopes {
  Real l, b, s;
};
using ChordSlopes = BasicChordSlopes<double>;

template <class Real>
struct BasicChordCurvatures {
  Real ll, lb, ls, bb, bs, ss;
};
using ChordCurvatures = BasicChordCurvatures<double>;

// Gradient and Hessian in the nodal unknowns follow with
//
//   ∂l = r,  ∂σ = 3 (e3 + e6) − 6 z/l,  ∂b = e6 − e3,  ∂²l = z zᵀ/l,  ∂²σ = 6 (r zᵀ + z rᵀ)/l²,
//   r = (−c, −s, 0, c, s, 0),  z = (s, −c, 0, −s, c, 0)  of the chord's direction (c, s)                 (2)
//
// The force on the first end is minus that on the second, and so are their derivatives.
template <class Real>
ARCWALL_IN_PLACE void nodal_forces(const BasicChordMotion<Real>& at, const BasicChordSlopes<Real>& U, Real* f) {
  const Real c = at.x / at.length, s = at.y / at.length, across = 6.0 * U.s / at.length;
  f[3] = U.l * c + across * s;
  f[4] = U.l * s - across * c;
  f[0] = -f[3];
  f[1] = -f[4];
  f[2] = 3.0 * U.s - U.b;
  f[5] = 3.0 * U.s + U.b;
}

// K = Σ U_ab ∂a ∂bᵀ + U_l ∂²l + U_σ ∂²σ by (2), the lower triangle, sorted by r, z and the two rotations (θ1: 3σ − b,
// θ2: 3σ + b).
template <class Real>
ARCWALL_IN_PLACE void nodal_stiffness(const BasicChordMotion<Real>& at, const BasicChordSlopes<Real>& U,
                                      const BasicChordCurvatures<Real>& V, Real* K) {
  const Real k = 1.0 / at.length, c = at.x * k, s = at.y * k;
  const Real rr = V.ll, rz = 6.0 * (U.s * k - V.ls) * k, zz = (U.l + 36.0 * V.ss * k) * k;
  const Real xx = rr * (c * c) - 2.0 * rz * (c * s) + zz * (s * s);
  const Real xy = (rr - zz) * (c * s) + rz * (c * c - s * s);
  const Real yy = rr * (s * s) + 2.0 * rz * (c * s) + zz * (c * c);
  const Real r1 = 3.0 * V.ls - V.lb, r2 = 3.0 * V.ls + V.lb;
  const Real z1 = -6.0 * (3.0 * V.ss - V.bs) * k, z2 = -6.0 * (3.0 * V.ss + V.bs) * k;
  const Real x1 = r1 * c - z1 * s, y1 = r1 * s + z1 * c, x2 = r2 * c - z2 * s, y2 = r2 * s + z2 * c;
  const auto at_entry = [K](int row, int column) -> Real& { return K[row + 6 * column]; };
  for (const int end : {0, 3}) {
    at_entry(end, end) = xx;
    at_entry(end + 1, end) = xy;
    at_entry(end + 1, end + 1) = yy;
  }
  at_entry(3, 0) = -xx;
  at_entry(4, 0) = at_entry(3, 1) = -xy;
  at_entry(4, 1) = -yy;
  at_entry(2, 0) = -x1;
  at_entry(2, 1) = -y1;
  at_entry(3, 2) = x1;
  at_entry(4, 2) = y1;
  at_entry(5, 0) = -x2;
  at_entry(5, 1) = -y2;
  at_entry(5, 3) = x2;
  at_entry(5, 4) = y2;
  at_entry(2, 2) = 9.0 * V.ss - 6.0 * V.bs + V.bb;
  at_entry(5, 5) = 9.0 * V.ss + 6.0 * V.bs + V.bb;
  at_entry(5, 2) = 9.0 * V.ss - V.bb;
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
  const StretchTaper* taper = nullptr;                                              // null: EA is the same all along
  std::array<double, 2> ends{};                                                     // S1, S2 of a tapering stretch
  Eigen::Matrix<double, terms, 1> angle = Eigen::Matrix<double, terms, 1>::Zero();  // coefficients of ξ − ½
  Eigen::Matrix<double, terms, 3> angle_gradient = Eigen::Matrix<double, terms, 3>::Zero();
  Vec2 force = Vec2::Zero();  // along the chord and across
  Eigen::Matrix<double, 2, 3> force_gradient = Eigen::Matrix<double, 2, 3>::Zero();

  double EA_at(double xi) const {
    return taper == nullptr ? EA : EA / taper->softness((1.0 - xi) * ends[0] + xi * ends[1]);
  }
};

/// The place at ξ on such an axis.
BeamPlace place_on(const BentAxis& axis, const ChordMotion& at, double angle1, double xi);

}  // namespace arcwall
