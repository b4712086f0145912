#include "elements/classic_beam.hpp"

#include "elements/updated_classic_beam.hpp"

namespace arcwall {

namespace {

BeamReference beam_reference(const StretchReference& stretch) {
  const RestChord rest = rest_chord(stretch);
  return {.chord = rest.chord, .length = stretch.length, .slope1 = rest.slope1, .slope2 = rest.slope2};
}

}  // namespace

ClassicBeam::ClassicBeam(const BeamReference& reference, double EA, double EI)
    : material_(classic_beam_material(reference.chord.x(), reference.chord.y(), reference.chord.norm(),
                                      reference.length, reference.slope1, reference.slope2, EA, EI)),
      EA_(EA),
      EI_(EI) {}

ClassicBeam::ClassicBeam(const StretchReference& stretch, double EA, double EI)
    : ClassicBeam(beam_reference(stretch), EA, EI) {
  const std::array<RestChord, 2> chords = rest_chord_rate(stretch);
  for (std::size_t i = 0; i < 2; ++i)
    rates_[i] =
        classic_beam_rate(material_, stretch.length_rate[i], chords[i].length, chords[i].slope1, chords[i].slope2);
}

inline RestChord ClassicBeam::rest() const {
  const double b = material_.b, third = material_.s / 3.0;
  return {.chord = {material_.x, material_.y},
          .length = material_.chord,
          .slope1 = 0.5 * (third - b),
          .slope2 = 0.5 * (third + b)};
}

double ClassicBeam::evaluate(const double* u, double* f, double* K) const {
  const ChordMotion at = motion_of(material_.x, material_.y, material_.chord, u);
  const ClassicBeamEnergy<double> U(material_, at);
  if (f != nullptr) nodal_forces(at, U.slopes(), f);
  if (K != nullptr) nodal_stiffness(at, U.slopes(), U.curvatures(), K);
  return U.energy();
}

std::unique_ptr<Element> ClassicBeam::updated(const double* u) const {
  const Vec2 chord(material_.x, material_.y);
  return std::make_unique<UpdatedClassicBeam>(u, chord, UpdatedClassicBeam::Resultants{}, EA_, EI_);
}

void ClassicBeam::respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const {
  const ChordMotion at = motion_of(rest(), ends);
  const ClassicBeamEnergy<double> U(material_, at);
  out.energy = U.energy();
  respond_along(at, U.slopes(), U.curvatures(), out);
  if (!with_rates) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const ChordSlopes rate = U.slope_rates(rates_[i]);
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
  const ClassicBeamEnergy<double> d(material_, at);
  const ChordSlopes U = d.slopes();
  const ChordCurvatures W = d.curvatures();
  const double k = 6.0 / d.l;
  BentAxis axis{.length = material_.length, .EA = EA_};
  axis.force << U.l, -k * U.s;
  axis.force_gradient << W.ll, W.lb, W.ls, -k * (W.ls - U.s / d.l), -k * W.bs, -k * W.ss;

  const double across = axis.force.y() / (EA_ + axis.force.x());
  const Eigen::RowVector3d across_gradient =
      (axis.force_gradient.row(1) - across * axis.force_gradient.row(0)) / (EA_ + axis.force.x());
  const double c = d.v.value + 12.0 * d.q * across;
  const Eigen::RowVector3d c_gradient = Eigen::RowVector3d(0.0, d.v.b, d.v.s) + 12.0 * d.q * across_gradient +
                                        12.0 * across * Eigen::RowVector3d(0.0, d.q_b, d.q_s);
  axis.angle << (material_.s + d.ds) / 6.0 - 0.25 * c, material_.b + d.db, c, 0.0, 0.0;
  axis.angle_gradient.row(0) = Eigen::RowVector3d(0.0, 0.0, 1.0 / 6.0) - 0.25 * c_gradient;
  axis.angle_gradient.row(1) = Eigen::RowVector3d(0.0, 1.0, 0.0);
  axis.angle_gradient.row(2) = c_gradient;
  return place_on(axis, at, ends.angle1, xi);
}

}  // namespace arcwall
