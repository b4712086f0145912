#include "elements/classic_beam.hpp"

#include <cmath>

#include "elements/chord_frame.hpp"
#include "elements/updated_classic_beam.hpp"

namespace arcwall {

namespace {

BeamReference beam_reference(const StretchReference& stretch) {
  const RestChord rest = rest_chord(stretch);
  return {.chord = rest.chord, .length = stretch.length, .slope1 = rest.slope1, .slope2 = rest.slope2};
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

ClassicBeam::ClassicBeam(const StretchReference& stretch, double EA, double EI)
    : ClassicBeam(beam_reference(stretch), EA, EI) {
  const std::array<RestChord, 2> chords = rest_chord_rate(stretch);
  const BendTerm p = shortening(b_, s_), v = variation(b_, s_);
  for (std::size_t i = 0; i < 2; ++i) {
    const RestChord& rate = chords[i];
    const double b = rate.slope2 - rate.slope1, s = 3.0 * (rate.slope1 + rate.slope2);
    rates_[i] = {.length = stretch.length_rate[i],
                 .axial = rate.length * (1.0 + p.value) + chord_length_ * (p.b * b + p.s * s),
                 .b = b,
                 .s = s,
                 .c = v.b * b + v.s * s};
  }
}

// With the chord l at angle β, end slopes t_i = θ_i − (β − β₀) + t_i⁰ against it, b, σ and c as in chord_frame.hpp:
//
//   U = ½ EA h ε² + EI/(2h) [(b − b⁰)² + (c − c⁰)²/3] − 4 EI² (σ − σ⁰)² q / [EA h (l² + 24 q EI/EA)]   (1)
//   ε = [l (1 + q + q² − Q) − l₀ (1 + q⁰ + …)] / h                                                     (2)
//
// The last term of (1) is the tilt of the chord where the stretch varies along the element; without it and the factor
// of (2) the order drops from 4 to 2.
struct ClassicBeam::Deformation {
  double l, b, s, db, ds, dc;  // db = b − b⁰, …
  double h, EA;
  double a, N, bending, tilt;  // EA/h, EA ε, EI/h, 4 EI²/(EA h)
  double q, q_b, q_s;
  TiltFactor g;
  BendTerm p, v;

  double energy() const {
    return 0.5 * N * N * h / EA + 0.5 * bending * (db * db + dc * dc / 3.0) - tilt * ds * ds * g.value;
  }

  ChordSlopes slopes() const {
    return {.l = N * (1.0 + p.value) - tilt * ds * ds * g.l,
            .b = N * l * p.b + bending * (db + dc * v.b / 3.0) - tilt * ds * ds * g.q * q_b,
            .s = N * l * p.s + bending * dc * v.s / 3.0 - tilt * ds * (2.0 * g.value + ds * g.q * q_s)};
  }

  ChordCurvatures curvatures() const {
    const double m = 1.0 + p.value;
    return {.ll = a * m * m - tilt * ds * ds * g.ll,
            .lb = (a * l * m + N) * p.b - tilt * ds * ds * g.lq * q_b,
            .ls = (a * l * m + N) * p.s - tilt * ds * (2.0 * g.l + ds * g.lq * q_s),
            .bb = a * l * l * p.b * p.b + N * l * p.bb + bending * (1.0 + (v.b * v.b + dc * v.bb) / 3.0) -
                  tilt * ds * ds * (g.qq * q_b * q_b + g.q / 12.0),
            .bs = a * l * l * p.b * p.s + N * l * p.bs + bending * (v.b * v.s + dc * v.bs) / 3.0 -
                  tilt * ds * (2.0 * g.q * q_b + ds * g.qq * q_b * q_s),
            .ss = a * l * l * p.s * p.s + N * l * p.ss + bending * (v.s * v.s + dc * v.ss) / 3.0 -
                  tilt * (2.0 * g.value + 4.0 * ds * g.q * q_s + ds * ds * (g.qq * q_s * q_s + g.q / 180.0))};
  }

  // Of the slopes, where l, b and σ stay and the stress-free state changes: all of (1) is of order −1 in h, and the
  // rest is in ε, b⁰, c⁰ and σ⁰.
  ChordSlopes slope_rate(const Rate& rest) const {
    const ChordSlopes U = slopes();
    const double N_rate = -a * rest.axial, with_h = -rest.length / h;
    return {.l = with_h * U.l + N_rate * (1.0 + p.value) + 2.0 * tilt * ds * rest.s * g.l,
            .b = with_h * U.b + N_rate * l * p.b - bending * (rest.b + rest.c * v.b / 3.0) +
                 2.0 * tilt * ds * rest.s * g.q * q_b,
            .s = with_h * U.s + N_rate * l * p.s - bending * rest.c * v.s / 3.0 +
                 2.0 * tilt * rest.s * (g.value + ds * g.q * q_s)};
  }
};

inline ClassicBeam::Deformation ClassicBeam::deform(double length, double stretch, double d1, double d2) const {
  const double l = length, h = length_;
  const double db = d2 - d1, ds = 3.0 * (d1 + d2), b = b_ + db, s = s_ + ds;
  const BendTerm p = shortening(b, s), v = variation(b, s);
  const double q = b * b / 24.0 + s * s / 360.0;
  return {.l = l,
          .b = b,
          .s = s,
          .db = db,
          .ds = ds,
          .dc = v.value - c_,
          .h = h,
          .EA = EA_,
          .a = EA_ / h,
          .N = EA_ * (stretch * (1.0 + p.value) + chord_length_ * (p.value - shortening_)) / h,
          .bending = EI_ / h,
          .tilt = 4.0 * EI_ * EI_ / (EA_ * h),
          .q = q,
          .q_b = b / 12.0,
          .q_s = s / 180.0,
          .g = tilt_factor(l, q, EI_ / EA_),
          .p = p,
          .v = v};
}

inline RestChord ClassicBeam::rest() const {
  return {.chord = chord_, .length = chord_length_, .slope1 = 0.5 * (s_ / 3.0 - b_), .slope2 = 0.5 * (s_ / 3.0 + b_)};
}

double ClassicBeam::evaluate(const double* u, double* f, double* K) const {
  const ChordMotion at = motion_of({.chord = chord_, .length = chord_length_}, u);
  const Deformation d = deform(at.length, at.stretch, at.d1, at.d2);
  if (f == nullptr && K == nullptr) return d.energy();
  const ChordSlopes U = d.slopes();
  const ChordDirection chord(at);
  if (f != nullptr) nodal_forces(chord, at.length, U, f);
  if (K != nullptr) nodal_stiffness(chord, at.length, U, d.curvatures(), K);
  return d.energy();
}

std::unique_ptr<Element> ClassicBeam::updated(const double* u) const {
  return std::make_unique<UpdatedClassicBeam>(u, chord_, UpdatedClassicBeam::Resultants{}, EA_, EI_);
}

void ClassicBeam::respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const {
  const ChordMotion at = motion_of(rest(), ends);
  const Deformation d = deform(at.length, at.stretch, at.d1, at.d2);
  out.energy = d.energy();
  respond_along(at, d.slopes(), d.curvatures(), out);
  if (!with_rates) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const ChordSlopes rate = d.slope_rate(rates_[i]);
    out.force_rate[i] = chord_gradient(at).transpose() * Eigen::Vector3d(rate.l, rate.b, rate.s);
  }
}

// The angle of chord_frame.hpp (1) in another form, with the force (N_c, V) along and across the chord as it follows
// from the energy:
//
//   θ = σ/6 + b x + c (x² − ¼),   c = c(1) + 12 q V/(EA + N_c)
//
// The second part of c is what the tilt of the chord leaves to bend: ∫(1 + N/EA) sin θ = 0 moves a by −2 q V/(EA +
// N_c).
BeamPlace ClassicBeam::place(const BeamEnds& ends, double xi) const {
  const ChordMotion at = motion_of(rest(), ends);
  const Deformation d = deform(at.length, at.stretch, at.d1, at.d2);
  const ChordSlopes U = d.slopes();
  const ChordCurvatures W = d.curvatures();
  const double k = 6.0 / d.l;
  BentAxis axis{.length = length_, .EA = EA_};
  axis.force << U.l, -k * U.s;
  axis.force_gradient << W.ll, W.lb, W.ls, -k * (W.ls - U.s / d.l), -k * W.bs, -k * W.ss;

  const double across = axis.force.y() / (EA_ + axis.force.x());
  const Eigen::RowVector3d across_gradient =
      (axis.force_gradient.row(1) - across * axis.force_gradient.row(0)) / (EA_ + axis.force.x());
  const double c = d.v.value + 12.0 * d.q * across;
  const Eigen::RowVector3d c_gradient = Eigen::RowVector3d(0.0, d.v.b, d.v.s) + 12.0 * d.q * across_gradient +
                                        12.0 * across * Eigen::RowVector3d(0.0, d.q_b, d.q_s);
  axis.angle << d.s / 6.0 - 0.25 * c, d.b, c, 0.0, 0.0;
  axis.angle_gradient.row(0) = Eigen::RowVector3d(0.0, 0.0, 1.0 / 6.0) - 0.25 * c_gradient;
  axis.angle_gradient.row(1) = Eigen::RowVector3d(0.0, 1.0, 0.0);
  axis.angle_gradient.row(2) = c_gradient;
  return place_on(axis, at, ends.angle1, xi);
}

}  // namespace arcwall
