#include "elements/distributed_load.hpp"

#include <algorithm>
#include <optional>

#include "core/root_find.hpp"
#include "elements/cubic_axis.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

double DrivenLoad::evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const {
  const int n = unknown_count();
  double unit[max_unknowns];
  const double V = load_->evaluate(u, f != nullptr || f_lambda != nullptr ? unit : nullptr, K);
  const double factor = factor_.at(lambda);
  for (int i = 0; i < n && f != nullptr; ++i) f[i] = factor * unit[i];
  for (int i = 0; i < n && f_lambda != nullptr; ++i) f_lambda[i] = factor_.proportional * unit[i];
  for (int j = 0; j < n && K != nullptr; ++j)
    for (int i = j; i < n; ++i) K[i + n * j] *= factor;
  return factor * V;
}

void DrivenLoad::complete_end_forces(const double* u, double lambda, double* f) const {
  double unit[max_unknowns] = {};
  load_->complete_end_forces(u, lambda, unit);
  for (int i = 0; i < unknown_count(); ++i) f[i] += factor_.at(lambda) * unit[i];
}

namespace {

// Of the cubic through four equally spaced values on [0, 1].
double interpolated_angle(const std::array<double, StretchReference::samples>& values, double xi) {
  const double x = 3.0 * xi;
  return -(x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0 * values[0] + x * (x - 2.0) * (x - 3.0) / 2.0 * values[1] -
         x * (x - 1.0) * (x - 3.0) / 2.0 * values[2] + x * (x - 1.0) * (x - 2.0) / 6.0 * values[3];
}

}  // namespace

// Only the energy knows where the stretch is at rest. A load by plan is zero at its kinks: rates need not know where.
StretchLoad::Response StretchLoad::respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const {
  const CubicAxis now(r1, angle1, r2, angle2);
  const CubicAxis rest(Vec2::Zero(), stretch_.angles.front(), stretch_.chord, stretch_.angles.back());
  const CubicAxis::Sum at_rest(rest);
  CubicAxis::Sum sum(now);
  std::array<CubicAxis::Sum, 2> rate{sum, sum};
  Response out;
  const GaussRule rule = gauss_rule(3);
  const SmoothPieces pieces =
      load_.is_straight() ? SmoothPieces()
                          : SmoothPieces(load_, [&](double xi) { return interpolated_angle(stretch_.angles, xi); });
  for (std::size_t i = 0; i < 3 * pieces.count(); ++i) {
    const std::size_t piece = i / 3, g = i % 3;
    const double xi = pieces.begin(piece) + 0.5 * (1.0 + rule.xi[g]) * pieces.length(piece);
    const double ds = 0.5 * rule.weight[g] * pieces.length(piece) * stretch_.length;
    const double S = from_ + xi * (to_ - from_);
    const double angle = load_.is_straight() ? 0.0 : interpolated_angle(stretch_.angles, xi);
    const Vec2 q = load_.at(S, angle);
    out.energy -= ds * q.dot(sum.position(xi) - at_rest.position(xi));
    sum.add_slope(xi, -ds * q);
    for (std::size_t end = 0; end < 2; ++end) {
      Vec2 by_end = stretch_.length_rate[end] / stretch_.length * q + (end == 0 ? 1.0 - xi : xi) * load_.by_S(angle);
      if (!load_.is_straight()) by_end += interpolated_angle(stretch_.angle_rate[end], xi) * load_.by_angle(S, angle);
      rate[end].add_slope(xi, -ds * by_end);
    }
  }
  out.force = sum.gradient();
  out.stiffness = sum.hessian();
  for (std::size_t end = 0; end < 2; ++end) out.force_rate[end] = rate[end].gradient();
  return out;
}

double BeamDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  const Vec2 second = chord_ + Vec2(u[3], u[4]);
  const auto response = along_.respond({u[0], u[1]}, angles_[0] + u[2], second, angles_[1] + u[5]);
  if (f != nullptr) std::copy_n(response.force.data(), response.force.size(), f);
  if (K != nullptr) std::copy_n(response.stiffness.data(), response.stiffness.size(), K);
  return response.energy;
}

double TrussDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  double V = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double force = forces_[i / 2][static_cast<Index>(i % 2)];
    V -= force * u[i];
    if (f != nullptr) f[i] = -force;
  }
  if (K != nullptr) std::fill(K, K + 16, 0.0);
  return V;
}

SmoothPieces::SmoothPieces(const LineLoad& load, const std::function<double(double)>& angle) {
  if (load.measure != LoadMeasure::plan) return;
  constexpr int thirds = 3;
  count_ = 0;
  for (int i = 0; i < thirds; ++i) {
    const double a = double(i) / thirds, b = double(i + 1) / thirds;
    const double before = load.sign(angle(a)), behind = load.sign(angle(b));
    if (before * behind >= 0.0) continue;
    const auto sign = [&](double xi) { return std::optional(load.sign(angle(xi))); };
    if (const auto kink = bracketed_root(sign, a, before, b, behind, 1e-15)) ends_[++count_] = kink->at;
  }
  ends_[++count_] = 1.0;
}

void combine(const DrivenLineLoad& load, std::vector<DrivenLineLoad>& to) {
  const auto is_alike = [&](const DrivenLineLoad& other) {
    return other.load.frame == load.load.frame && other.load.measure == load.load.measure &&
           other.factor == load.factor;
  };
  const auto same = std::find_if(to.begin(), to.end(), is_alike);
  if (same == to.end()) return to.push_back(load);
  same->load.first += load.load.first;
  same->load.slope += load.load.slope;
}

}  // namespace arcwall
