#include "elements/wall_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "elements/wall_pressure_curve.hpp"

namespace arcwall {

namespace {

// exp(t) − 1 − t, to its digits at small t.
double exponential_energy(double t) {
  constexpr double small = 0.1;
  if (std::abs(t) > small) return std::expm1(t) - t;
  double sum = 1.0;
  for (int k = 12; k > 2; --k) sum = 1.0 + sum * t / k;
  return 0.5 * t * t * sum;
}

}  // namespace

PressureLaw::Response PressureLaw::at(double p) const {
  if (table_) {
    const SpringLaw::Response of_table = table_->at(p);
    return {.energy = of_table.energy, .pressure = of_table.force, .stiffness = of_table.stiffness};
  }
  if (!depth_) return {.energy = 0.5 * stiffness_ * p * p, .pressure = stiffness_ * p, .stiffness = stiffness_};
  const double c = *depth_, t = p / c;
  return {.energy = stiffness_ * c * c * exponential_energy(t),
          .pressure = stiffness_ * c * std::expm1(t),
          .stiffness = stiffness_ * std::exp(t)};
}

WallPressure::WallPressure(Shape shape, std::vector<Node> nodes, int stride, std::shared_ptr<const WallGap> wall,
                           std::shared_ptr<const PressureLaw> law)
    : shape_(shape), nodes_(std::move(nodes)), stride_(stride), wall_(std::move(wall)), law_(std::move(law)) {}

std::vector<PressedPart> WallPressure::pressed(const double* u, double lambda) const {
  const Curve curve(*this, u);
  return curve.gaps(lambda).pressed_parts();
}

double WallPressure::evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const {
  const auto n = static_cast<std::size_t>(unknown_count());
  if (f != nullptr) std::fill_n(f, n, 0.0);
  if (K != nullptr) std::fill_n(K, n * n, 0.0);
  if (f_lambda != nullptr) std::fill_n(f_lambda, n, 0.0);
  const Curve curve(*this, u);
  const auto parts = curve.gaps(lambda).pressed_parts();
  if (parts.empty()) return 0.0;
  double V = 0.0;
  Curve::Controls slope = Curve::Controls::Zero(), slope_rate = Curve::Controls::Zero();
  Curve::ControlsSquare second = Curve::ControlsSquare::Zero();
  for (const PressedPart& part : parts)
    for_each_gauss_point(curve, lambda, part, [&](const GaussPoint& at) {
      V += at.energy;
      if (f == nullptr && K == nullptr) return;
      const Curve::Gradient gradient = curve.gradient(at.t);
      slope += gradient.transpose() * at.slope;
      slope_rate += gradient.transpose() * at.slope_rate;
      if (K == nullptr) return;
      second += gradient.transpose() * at.second * gradient;
      curve.add_second(at.t, at.slope, second);
    });
  if (f != nullptr) curve.add(slope, f);
  if (f_lambda != nullptr) curve.add(slope_rate, f_lambda);
  if (K != nullptr) curve.add(slope, second, K);
  return V;
}

Vec2 WallPressure::place(const double* u, double fraction) const { return Curve(*this, u).place(fraction); }

double WallPressure::length_rate(double fraction) const {
  const std::array<double, max_unknowns> rest{};
  return Curve(*this, rest.data()).speed(fraction);
}

double WallPressure::gap(const double* u, double lambda, double fraction) const {
  return Curve(*this, u).gap(lambda, fraction).value;
}

WallPressure::LeastGap WallPressure::least_gap(const double* u, double lambda) const {
  const Curve curve(*this, u);
  const Curve::GapAlong gap = curve.gaps(lambda);
  const Curve::GapAlong::Samples seen = gap.sampled();
  LeastGap least;
  const auto look_at = [&](double t, double value) {
    if (value < least.value) least = {.fraction = t, .value = value};
  };
  for (const Curve::GapAlong::Sample& one : seen) look_at(one.t, one.value);
  for (std::size_t k = 0; k + 1 < seen.size(); ++k)
    if (seen[k].rate < 0.0 && seen[k + 1].rate > 0.0)
      if (const auto turn = gap.turn_between(seen[k], seen[k + 1])) look_at(*turn, gap(*turn).value);
  return least;
}

WallPressure::GapGradient WallPressure::gap_gradient(const double* u, double lambda, double fraction) const {
  GapGradient out;
  const Curve curve(*this, u);
  const Vec2 at = curve.place(fraction);
  if (!std::isfinite(wall_->slope(at, lambda).value)) return out;
  const WallGap::Response gap = wall_->at(at, lambda);
  const Curve::Controls slope = curve.gradient(fraction).transpose() * gap.slope;
  curve.add(slope, out.by_unknowns.data());
  out.rate = gap.rate;
  return out;
}

// The force on the element at a place is −∂W/∂r.
WallPressure::Resultant WallPressure::resultant(const double* u, double lambda, const Vec2& about) const {
  Resultant out;
  const Curve curve(*this, u);
  std::array<Curve::Controls, 3> by_controls{Curve::Controls::Zero(), Curve::Controls::Zero(), Curve::Controls::Zero()};
  for (const PressedPart& part : curve.gaps(lambda).pressed_parts())
    for_each_gauss_point(curve, lambda, part, [&](const GaussPoint& at) {
      const Vec2 force = -at.slope, force_rate = -at.slope_rate, arm = curve.place(at.t) - about;
      const Curve::Gradient gradient = curve.gradient(at.t), of_force = -at.second * gradient;
      for (Index i = 0; i < 2; ++i) {
        out.value[static_cast<std::size_t>(i)] += force[i];
        out.rate[static_cast<std::size_t>(i)] += force_rate[i];
        by_controls[static_cast<std::size_t>(i)] += of_force.row(i).transpose();
      }
      out.value[2] += cross(arm, force);
      out.rate[2] += cross(arm, force_rate);
      by_controls[2] += arm.x() * of_force.row(1).transpose() - arm.y() * of_force.row(0).transpose() +
                        force.y() * gradient.row(0).transpose() - force.x() * gradient.row(1).transpose();
    });
  for (std::size_t i = 0; i < 3; ++i) curve.add(by_controls[i], out.by_unknowns[i].data());
  return out;
}

WallPressure::PartForce WallPressure::force_of(const double* u, double lambda, const PressedPart& part) const {
  const Curve curve(*this, u);
  PartForce out;
  double moment = 0.0;
  for_each_gauss_point(curve, lambda, part, [&](const GaussPoint& at) {
    const double force = at.length * at.pressure;
    out.force += force;
    out.length += at.length;
    out.vector -= at.slope;
    moment += force * at.t;
  });
  out.centre = out.force > 0.0 ? moment / out.force : 0.5 * (part.from + part.to);
  return out;
}

double WallPressure::pressure(const double* u, double lambda, double fraction) const {
  const double gap = Curve(*this, u).gap(lambda, fraction).value;
  return gap < 0.0 ? law_->at(-gap).pressure : 0.0;
}

bool WallPressure::leaves_surface(const double* u, double lambda) const {
  const Curve curve(*this, u);
  const Curve::GapAlong gap = curve.gaps(lambda);
  const Curve::GapAlong::Samples seen = gap.sampled();
  const auto is_there = [](const Curve::GapAlong::Sample& one) { return std::isfinite(one.value); };
  return std::any_of(seen.begin(), seen.end(), [](const Curve::GapAlong::Sample& one) { return one.value < 0.0; }) &&
         !std::all_of(seen.begin(), seen.end(), is_there);
}

}  // namespace arcwall
