#pragma once

#include "elements/chord_frame.hpp"

// The energy of the classic beam in the chord's length l, the bend b and the skew σ, for one element or several in
// lanes (docs/theory.md, section 2).
namespace arcwall {

/// Stress-free state and stiffnesses of an element.
template <class Real>
struct ClassicBeamMaterial {
  Real x, y, chord;  // components of the stress-free chord, its length l₀
  Real length;       // h, of the stress-free axis
  Real b, s, c;      // b⁰, σ⁰ and c⁰
  Real shortening;   // h/l₀ − 1 by chord_frame.hpp (1)
  Real stretching;   // EA/h
  Real bending;      // EI/h
  Real tilting;      // 4 EI²/(EA h)
  Real flexibility;  // 24 EI/EA
};

/// Of a stress-free axis of the length `length`, whose chord (x, y) of the length `chord` it leaves at the angles
/// `slope1` and `slope2`.
template <class Real>
ARCWALL_IN_PLACE ClassicBeamMaterial<Real> classic_beam_material(const Real& x, const Real& y, const Real& chord,
                                                                 const Real& length, const Real& slope1,
                                                                 const Real& slope2, double EA, double EI) {
  const Real b = slope2 - slope1, s = 3.0 * (slope1 + slope2);
  return {.x = x,
          .y = y,
          .chord = chord,
          .length = length,
          .b = b,
          .s = s,
          .c = variation(b, s).value,
          .shortening = shortening(b, s).value,
          .stretching = EA / length,
          .bending = EI / length,
          .tilting = 4.0 * EI * EI / (EA * length),
          .flexibility = 24.0 * EI / EA};
}

/// Rates of the stress-free state by a material coordinate; `axial` is that of l₀ (1 + p₀).
template <class Real>
struct ClassicBeamRate {
  Real length = 0.0, axial = 0.0, b = 0.0, s = 0.0, c = 0.0;
};

/// From those of h, of the chord's length and of the angles at its ends.
template <class Real>
ARCWALL_IN_PLACE ClassicBeamRate<Real> classic_beam_rate(const ClassicBeamMaterial<Real>& of, const Real& length,
                                                         const Real& chord, const Real& slope1, const Real& slope2) {
  const BasicBendTerm<Real> p = shortening(of.b, of.s), v = variation(of.b, of.s);
  const Real b = slope2 - slope1, s = 3.0 * (slope1 + slope2);
  return {.length = length,
          .axial = chord * (1.0 + p.value) + of.chord * (p.b * b + p.s * s),
          .b = b,
          .s = s,
          .c = v.b * b + v.s * s};
}

// With end slopes t_i = θ_i − (β − β₀) + t_i⁰ against the chord l at angle β, and b, σ and c as in chord_frame.hpp:
//
//   U = ½ EA h ε² + EI/(2h) [(b − b⁰)² + (c − c⁰)²/3] − 4 EI² (σ − σ⁰)² q / [EA h (l² + 24 q EI/EA)]   (1)
//   ε = [l (1 + q + q² − Q) − l₀ (1 + q⁰ + …)] / h                                                     (2)
//
// The last term of (1) is the tilt of the chord where the stretch varies along the element; without it and the factor
// of (2) the order drops from 4 to 2.
template <class Real>
struct ClassicBeamEnergy {
  // The factor q/(l² + 24 q EI/EA), with its derivatives by the chord and by q.
  struct TiltFactor {
    Real value, l, q, ll, lq, qq;
  };

  const ClassicBeamMaterial<Real>& material;
  Real l, ds, db, dc;  // σ − σ⁰, b − b⁰, c − c⁰
  Real N;              // EA ε
  Real q, q_b, q_s;
  BasicBendTerm<Real> p, v;  // shortening and variation
  TiltFactor g;

  ARCWALL_IN_PLACE ClassicBeamEnergy(const ClassicBeamMaterial<Real>& of, const BasicChordMotion<Real>& at)
      : material(of), l(at.length), ds(3.0 * (at.d1 + at.d2)), db(at.d2 - at.d1) {
    const Real b = of.b + db, s = of.s + ds;
    p = arcwall::shortening(b, s);
    v = variation(b, s);
    dc = v.value - of.c;
    N = of.stretching * (at.stretch * (1.0 + p.value) + of.chord * (p.value - of.shortening));
    q_b = b * (1.0 / 12.0);
    q_s = s * (1.0 / 180.0);
    q = 0.5 * (b * q_b + s * q_s);
    g = tilt_factor();
  }

  ARCWALL_IN_PLACE Real energy() const {
    return 0.5 * (N * N / material.stretching + material.bending * (db * db + dc * dc * (1.0 / 3.0))) -
           material.tilting * (ds * ds) * g.value;
  }

  ARCWALL_IN_PLACE BasicChordSlopes<Real> slopes() const {
    const Real tilt = material.tilting * ds, tilt_by_q = tilt * ds * g.q;
    const Real moment = material.bending * dc * (1.0 / 3.0), Nl = N * l;
    return {.l = N * (1.0 + p.value) - tilt * ds * g.l,
            .b = Nl * p.b + material.bending * db + moment * v.b - tilt_by_q * q_b,
            .s = Nl * p.s + moment * v.s - 2.0 * (tilt * g.value) - tilt_by_q * q_s};
  }

  ARCWALL_IN_PLACE BasicChordCurvatures<Real> curvatures() const {
    const Real m = 1.0 + p.value, al = material.stretching * l, alm = al * m + N, all = al * l, Nl = N * l;
    const Real bending = material.bending * (1.0 / 3.0);
    const Real tilt = material.tilting, tilt1 = tilt * ds, tilt2 = tilt1 * ds;
    const Real tilt_qq = tilt2 * g.qq, tilt_q = tilt2 * g.q, tilt_lq = tilt2 * g.lq, tilt1_q = 2.0 * (tilt1 * g.q);
    return {
        .ll = material.stretching * (m * m) - tilt2 * g.ll,
        .lb = alm * p.b - tilt_lq * q_b,
        .ls = alm * p.s - 2.0 * (tilt1 * g.l) - tilt_lq * q_s,
        .bb = all * (p.b * p.b) + Nl * p.bb + material.bending + bending * (v.b * v.b + dc * v.bb) -
              tilt_qq * (q_b * q_b) - tilt_q * (1.0 / 12.0),
        .bs = all * (p.b * p.s) + Nl * p.bs + bending * (v.b * v.s + dc * v.bs) - tilt1_q * q_b - tilt_qq * (q_b * q_s),
        .ss = all * (p.s * p.s) + Nl * p.ss + bending * (v.s * v.s + dc * v.ss) - 2.0 * (tilt * g.value) -
              2.0 * (tilt1_q * q_s) - tilt_qq * (q_s * q_s) - tilt_q * (1.0 / 180.0)};
  }

  /// Of the slopes, where l, b and σ stay and the stress-free state changes: all of (1) is of order −1 in h, and the
  /// rest is in ε, b⁰, c⁰ and σ⁰.
  ARCWALL_IN_PLACE BasicChordSlopes<Real> slope_rates(const ClassicBeamRate<Real>& rest) const {
    const BasicChordSlopes<Real> U = slopes();
    const Real N_rate = -material.stretching * rest.axial, with_h = -rest.length / material.length;
    const Real tilt = 2.0 * material.tilting * rest.s;
    return {.l = with_h * U.l + N_rate * (1.0 + p.value) + tilt * ds * g.l,
            .b = with_h * U.b + N_rate * l * p.b - material.bending * (rest.b + rest.c * v.b * (1.0 / 3.0)) +
                 tilt * ds * g.q * q_b,
            .s = with_h * U.s + N_rate * l * p.s - material.bending * rest.c * v.s * (1.0 / 3.0) +
                 tilt * (g.value + ds * g.q * q_s)};
  }

 private:
  ARCWALL_IN_PLACE TiltFactor tilt_factor() const {
    const Real &c = material.flexibility, ll = l * l, cq = c * q;
    const Real inverse = 1.0 / (ll + cq), square = inverse * inverse, cube = square * inverse;
    return {.value = q * inverse,
            .l = -2.0 * (l * q) * square,
            .q = ll * square,
            .ll = 2.0 * q * (3.0 * ll - cq) * cube,
            .lq = 2.0 * l * (cq - ll) * cube,
            .qq = -2.0 * (c * ll) * cube};
  }
};

}  // namespace arcwall
