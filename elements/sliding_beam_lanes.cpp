#include "elements/sliding_beam_lanes.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cassert>

#include "elements/classic_beam_energy.hpp"

namespace arcwall {

namespace {

using End = SlidingBeamLanes::End;
using Properties = SlidingBeamLanes::Properties;
using Response = SlidingBeamLanes::Response;
using Wanted = SlidingBeamLanes::Wanted;

// The deviation y from the axis at a place, and its derivatives by s.
struct DeviationLanes {
  Lanes value, slope, second, third, fourth;
};

ARCWALL_IN_PLACE DeviationLanes deviation_at(const Properties& of, const Lanes& s) {
  DeviationLanes y{.value = 0.0, .slope = 0.0, .second = 0.0, .third = 0.0, .fourth = 0.0};
  for (const SlidingBeamLanes::Wave& wave : of.waves) {
    const CosineAndSine<Lanes> turn = cosine_and_sine(wave.number * s);
    const double k = wave.number;
    const Lanes height = wave.height * turn.sine, slope = (wave.height * k) * turn.cosine;
    y.value += height;
    y.slope += slope;
    y.second -= (k * k) * height;
    y.third -= (k * k) * slope;
    y.fourth += (k * k * k * k) * height;
  }
  return y;
}

// Gauss's rule on −1 to 1.
template <unsigned points>
struct RuleInLanes {
  double node[points], weight[points];

  RuleInLanes() {
    using Rule = boost::math::quadrature::gauss<double, points>;
    unsigned next = 0;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
      for (const double sign : {-1.0, 1.0}) {
        if (Rule::abscissa()[i] == 0.0 && sign > 0.0) continue;
        node[next] = sign * Rule::abscissa()[i];
        weight[next++] = Rule::weights()[i];
      }
  }
};
const RuleInLanes<5> rule_of_5;
const RuleInLanes<7> rule_of_7;
const RuleInLanes<10> rule_of_10;

// ∫ √(1 + y′²) ds
template <unsigned points>
ARCWALL_IN_PLACE Lanes length_by(const RuleInLanes<points>& rule, const Properties& of, const Lanes& from,
                                 const Lanes& to) {
  const Lanes middle = 0.5 * (from + to), half = 0.5 * (to - from);
  Lanes sum = 0.0;
  for (unsigned i = 0; i < points; ++i) {
    const Lanes slope = deviation_at(of, middle + rule.node[i] * half).slope;
    sum += rule.weight[i] * square_root(1.0 + slope * slope);
  }
  return half * sum;
}

// v = √(1 + y′²) with its derivatives:  v v′ = y′y″,  v v″ = y″² + y′y‴ − v′²,  v v‴ = 3 y″y‴ + y′y⁗ − 3 v′v″.
struct SpeedLanes {
  Lanes value, first, second, third;
};

ARCWALL_IN_PLACE SpeedLanes speed_of(const DeviationLanes& y) {
  const Lanes v = square_root(1.0 + y.slope * y.slope), inverse = 1.0 / v;
  const Lanes first = y.slope * y.second * inverse;
  const Lanes second = (y.second * y.second + y.slope * y.third - first * first) * inverse;
  const Lanes third = (3.0 * (y.second * y.third) + y.slope * y.fourth - 3.0 * (first * second)) * inverse;
  return {.value = v, .first = first, .second = second, .third = third};
}

// ∫ v ds by Hermite's rule of degree 7 on an element of length h, from both ends. On a part of a wave of the phase φ it
// is off by at most (2φ)⁸ · 4·10⁻⁸.
ARCWALL_IN_PLACE Lanes length_by_ends(const SpeedLanes& a, const SpeedLanes& b, const Lanes& h) {
  const Lanes odd = (a.first - b.first) * (3.0 / 28.0) + (h * h) * ((a.third - b.third) * (1.0 / 1680.0));
  return h * (0.5 * (a.value + b.value) + h * (odd + h * ((a.second + b.second) * (1.0 / 84.0))));
}

// As ImperfectAxis::length().
ARCWALL_IN_PLACE Lanes length_between(const Properties& of, const End& first, const SpeedLanes& speed1,
                                      const End& second, const SpeedLanes& speed2) {
  const Lanes &from = first.s, &to = second.s;
  if (of.waves.empty()) return to - from;
  double phase = 0.0;
  for (int lane = 0; lane < Lanes::count; ++lane)
    phase = std::max(phase, of.greatest_number * std::abs(to[lane] - from[lane]));
  if (phase <= 0.05) return length_by_ends(speed1, speed2, to - from);
  if (phase <= 0.25) return length_by(rule_of_5, of, from, to);
  if (phase <= 1.0) return length_by(rule_of_7, of, from, to);
  return length_by(rule_of_10, of, from, to);
}

// With the axis along x, the chord (Δs, Δy) at the angle β turns by −(y′ Δs − Δy)/l² where its end moves by ds (1, y′),
// and the tangent there by y″/(1 + y′²).
ARCWALL_IN_PLACE void respond_in_lanes(const Properties& of, const End& first, const End& second, Wanted wanted,
                                       Response& out) {
  const DeviationLanes y1 = deviation_at(of, first.s), y2 = deviation_at(of, second.s);
  const SpeedLanes speed1 = speed_of(y1), speed2 = speed_of(y2);
  const Lanes along = second.s - first.s, across = y2.value - y1.value;
  const Lanes square = along * along + across * across, chord = square_root(square);
  const Lanes direction = arc_tangent(across, along), one = 1.0;
  const Lanes slope1 = arc_tangent(y1.slope, one) - direction, slope2 = arc_tangent(y2.slope, one) - direction;
  const ClassicBeamMaterial<Lanes> material = classic_beam_material(
      along, across, chord, length_between(of, first, speed1, second, speed2), slope1, slope2, of.EA, of.EI);

  const BasicChordMotion<Lanes> at =
      motion_between(second.x - first.x, second.z - first.z, first.angle, second.angle, chord, slope1, slope2);
  const ClassicBeamEnergy<Lanes> U(material, at);
  const BasicChordSlopes<Lanes> slopes = U.slopes();
  nodal_forces(at, slopes, out.force);
  if (wanted == Wanted::force) return;
  nodal_stiffness(at, slopes, U.curvatures(), out.stiffness);
  if (wanted == Wanted::stiffness) return;

  const Lanes turn1 = (across - along * y1.slope) / square, turn2 = (along * y2.slope - across) / square;
  const ClassicBeamRate<Lanes> rate1 = classic_beam_rate(material, -speed1.value, (-along - across * y1.slope) / chord,
                                                         y1.second / (speed1.value * speed1.value) - turn1, -turn1);
  const ClassicBeamRate<Lanes> rate2 = classic_beam_rate(material, speed2.value, (along + across * y2.slope) / chord,
                                                         -turn2, y2.second / (speed2.value * speed2.value) - turn2);
  nodal_forces(at, U.slope_rates(rate1), out.force_rate[0]);
  nodal_forces(at, U.slope_rates(rate2), out.force_rate[1]);
}

#ifdef __x86_64__
[[gnu::target("avx")]] void respond_in_wide_lanes(const Properties& of, const End& first, const End& second,
                                                  Wanted wanted, Response& out) {
  respond_in_lanes(of, first, second, wanted, out);
}
#endif

}  // namespace

SlidingBeamLanes::SlidingBeamLanes(const ImperfectAxis& shape, double EA, double EI) : properties_{.EA = EA, .EI = EI} {
  assert(shape.is_straight());
  for (const SineDeviation& wave : shape.deviations()) {
    properties_.waves.push_back({.number = wave.waves * pi / shape.axis_length(), .height = wave.amplitude});
    properties_.greatest_number = std::max(properties_.greatest_number, std::abs(properties_.waves.back().number));
  }
}

void SlidingBeamLanes::respond(const End& first, const End& second, Wanted wanted, Response& out) const {
#ifdef __x86_64__
  if (has_wide_registers()) return respond_in_wide_lanes(properties_, first, second, wanted, out);
#endif
  respond_in_lanes(properties_, first, second, wanted, out);
}

}  // namespace arcwall
