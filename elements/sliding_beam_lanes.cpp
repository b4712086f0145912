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
using Rest = SlidingBeamLanes::Rest;
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

// v v′ = y′y″,  v v″ = y″² + y′y‴ − v′²,  v v‴ = 3 y″y‴ + y′y⁗ − 3 v′v″.
ARCWALL_IN_PLACE void find_rest(const Properties& of, const Lanes& s, Rest& out) {
  const DeviationLanes y = deviation_at(of, s);
  const Lanes v = square_root(1.0 + y.slope * y.slope), inverse = 1.0 / v, one = 1.0;
  const Lanes first = y.slope * y.second * inverse;
  const Lanes second = (y.second * y.second + y.slope * y.third - first * first) * inverse;
  const Lanes third = (3.0 * (y.second * y.third) + y.slope * y.fourth - 3.0 * (first * second)) * inverse;
  out = {.s = s,
         .deviation = y.value,
         .slope = y.slope,
         .bend = y.second,
         .angle = arc_tangent(y.slope, one),
         .speed = v,
         .speed_first = first,
         .speed_second = second,
         .speed_third = third};
}

// ∫ v ds by Hermite's rule of degree 7 on an element of length h, from both ends. On a part of a wave of the phase φ it
// is off by at most (2φ)⁸ · 4·10⁻⁸.
ARCWALL_IN_PLACE Lanes length_by_ends(const Rest& a, const Rest& b) {
  const Lanes h = b.s - a.s;
  const Lanes odd =
      (a.speed_first - b.speed_first) * (3.0 / 28.0) + (h * h) * ((a.speed_third - b.speed_third) * (1.0 / 1680.0));
  return h * (0.5 * (a.speed + b.speed) + h * (odd + h * ((a.speed_second + b.speed_second) * (1.0 / 84.0))));
}

// As ImperfectAxis::length().
ARCWALL_IN_PLACE Lanes length_between(const Properties& of, const Rest& first, const Rest& second) {
  const Lanes &from = first.s, &to = second.s;
  if (of.waves.empty()) return to - from;
  double phase = 0.0;
  for (int lane = 0; lane < Lanes::count; ++lane)
    phase = std::max(phase, of.greatest_number * std::abs(to[lane] - from[lane]));
  if (phase <= 0.05) return length_by_ends(first, second);
  if (phase <= 0.25) return length_by(rule_of_5, of, from, to);
  if (phase <= 1.0) return length_by(rule_of_7, of, from, to);
  return length_by(rule_of_10, of, from, to);
}

// With the axis along x, the chord (Δs, Δy) at the angle β turns by −(y′ Δs − Δy)/l² where its end moves by ds (1, y′),
// and the tangent there by y″/(1 + y′²).
ARCWALL_IN_PLACE void respond_in_lanes(const Properties& of, const End& first, const End& second, Wanted wanted,
                                       Response& out) {
  const Rest &r1 = first.rest, &r2 = second.rest;
  const Lanes along = r2.s - r1.s, across = r2.deviation - r1.deviation;
  const Lanes square = along * along + across * across, chord = square_root(square);
  const Lanes direction = arc_tangent(across, along), slope1 = r1.angle - direction, slope2 = r2.angle - direction;
  const ClassicBeamMaterial<Lanes> material =
      classic_beam_material(along, across, chord, length_between(of, r1, r2), slope1, slope2, of.EA, of.EI);

  const BasicChordMotion<Lanes> at =
      motion_between(second.x - first.x, second.z - first.z, first.angle, second.angle, chord, slope1, slope2);
  const ClassicBeamEnergy<Lanes> U(material, at);
  out.energy = U.energy();
  if (wanted == Wanted::energy) return;
  const BasicChordSlopes<Lanes> slopes = U.slopes();
  nodal_forces(at, slopes, out.force);
  if (wanted == Wanted::force) return;
  nodal_stiffness(at, slopes, U.curvatures(), out.stiffness);
  if (wanted == Wanted::stiffness) return;

  const Lanes turn1 = (across - along * r1.slope) / square, turn2 = (along * r2.slope - across) / square;
  const ClassicBeamRate<Lanes> rate1 = classic_beam_rate(material, -r1.speed, (-along - across * r1.slope) / chord,
                                                         r1.bend / (r1.speed * r1.speed) - turn1, -turn1);
  const ClassicBeamRate<Lanes> rate2 = classic_beam_rate(material, r2.speed, (along + across * r2.slope) / chord,
                                                         -turn2, r2.bend / (r2.speed * r2.speed) - turn2);
  nodal_forces(at, U.slope_rates(rate1), out.force_rate[0]);
  nodal_forces(at, U.slope_rates(rate2), out.force_rate[1]);
}

#ifdef __x86_64__
[[gnu::target("avx")]] void respond_in_wide_lanes(const Properties& of, const End& first, const End& second,
                                                  Wanted wanted, Response& out) {
  respond_in_lanes(of, first, second, wanted, out);
}
[[gnu::target("avx")]] void find_rest_in_wide_lanes(const Properties& of, const Lanes& s, Rest& out) {
  find_rest(of, s, out);
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

SlidingBeamLanes::Rest SlidingBeamLanes::rest_at(const Lanes& s) const {
  Rest rest;
#ifdef __x86_64__
  if (has_wide_registers()) {
    find_rest_in_wide_lanes(properties_, s, rest);
    return rest;
  }
#endif
  find_rest(properties_, s, rest);
  return rest;
}

SlidingBeamLanes::Rest SlidingBeamLanes::next_of(const Rest& these, const Rest& others) {
  const auto next = [&](Lanes Rest::*number) { return arcwall::next_of(these.*number, others.*number); };
  return {.s = next(&Rest::s),
          .deviation = next(&Rest::deviation),
          .slope = next(&Rest::slope),
          .bend = next(&Rest::bend),
          .angle = next(&Rest::angle),
          .speed = next(&Rest::speed),
          .speed_first = next(&Rest::speed_first),
          .speed_second = next(&Rest::speed_second),
          .speed_third = next(&Rest::speed_third)};
}

void SlidingBeamLanes::respond(const End& first, const End& second, Wanted wanted, Response& out) const {
#ifdef __x86_64__
  if (has_wide_registers()) return respond_in_wide_lanes(properties_, first, second, wanted, out);
#endif
  respond_in_lanes(properties_, first, second, wanted, out);
}

}  // namespace arcwall
