#include "elements/thermal_strain.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "core/unit_tangent.hpp"

namespace arcwall {

namespace {

// The cubic through angles at 0, ⅓, ⅔ and 1.
double interpolated(const std::array<double, StretchReference::samples>& angles, double t) {
  const double a = 3.0 * t, b = a - 1.0, c = a - 2.0, d = a - 3.0;
  return -b * c * d / 6.0 * angles[0] + a * c * d / 2.0 * angles[1] - a * b * d / 2.0 * angles[2] +
         a * b * c / 6.0 * angles[3];
}

// ∫ of a function over 0 ≤ t ≤ 1.
template <class Function>
Vec2 mean(const Function& function) {
  using Points = boost::math::quadrature::gauss<double, 7>;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < Points::abscissa().size(); ++i) {
    const double node = 0.5 * Points::abscissa()[i], weight = 0.5 * Points::weights()[i];
    sum += weight * function(0.5 + node);
    if (node != 0.0) sum += weight * function(0.5 - node);
  }
  return sum;
}

}  // namespace

// The bent stretch turns about its middle: θ(t) = θ⁰(t) + κ h (t − ½), t the part of its length. Its chord differs from
// the cold one, which is exact, by what the interpolated angles tell.
HeatedStretch heated(const StretchReference& cold, const ThermalStrain& thermal, double lambda) {
  const double h = cold.length, s = 1.0 + thermal.strain.at(lambda), kappa = thermal.curvature.at(lambda);
  const double s_rate = thermal.strain.proportional, kappa_rate = thermal.curvature.proportional;
  HeatedStretch out{.reference = cold, .stiffer = s, .stiffer_rate = s_rate};
  StretchReference& hot = out.reference;
  Vec2 chord = cold.chord, chord_by_kappa = Vec2::Zero();
  if (!thermal.curvature.is_zero()) {
    const auto added = [&](double t) { return kappa * h * (t - 0.5); };
    for (std::size_t k = 0; k < hot.angles.size(); ++k) {
      const double t = double(k) / double(hot.angles.size() - 1);
      hot.angles[k] += added(t);
      for (std::size_t i = 0; i < 2; ++i) hot.angle_rate[i][k] += kappa * cold.length_rate[i] * (t - 0.5);
    }
    const auto at_rest = [&](double t) { return interpolated(cold.angles, t); };
    chord += h * mean([&](double t) { return Vec2(unit_tangent(at_rest(t) + added(t)) - unit_tangent(at_rest(t))); });
    chord_by_kappa =
        h * mean([&](double t) { return Vec2(h * (t - 0.5) * perp(unit_tangent(at_rest(t) + added(t)))); });
    for (std::size_t i = 0; i < 2; ++i) {
      const auto turns = [&](double t) { return interpolated(cold.angle_rate[i], t); };
      hot.chord_rate[i] +=
          cold.length_rate[i] / h * (chord - cold.chord) +
          h * mean([&](double t) {
            const double angle = at_rest(t) + added(t), more = kappa * cold.length_rate[i] * (t - 0.5);
            return Vec2((turns(t) + more) * perp(unit_tangent(angle)) - turns(t) * perp(unit_tangent(at_rest(t))));
          });
    }
  }
  hot.length = s * h;
  hot.chord = s * chord;
  for (std::size_t i = 0; i < 2; ++i) {
    hot.length_rate[i] *= s;
    hot.chord_rate[i] *= s;
  }
  out.by_lambda = hot;
  out.by_lambda.end_rate = {0.0, 0.0};
  out.by_lambda.length_rate = {s_rate * h, 0.0};
  out.by_lambda.chord_rate = {s_rate * chord + s * kappa_rate * chord_by_kappa, Vec2::Zero()};
  for (std::size_t k = 0; k < hot.angles.size(); ++k) {
    out.by_lambda.angle_rate[0][k] = kappa_rate * h * (double(k) / double(hot.angles.size() - 1) - 0.5);
    out.by_lambda.angle_rate[1][k] = 0.0;
  }
  return out;
}

}  // namespace arcwall
