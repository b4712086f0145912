#include "elements/foundation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/cubic_axis.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

namespace {

constexpr int gauss_points = 3;

}  // namespace

// At rest the first end is at the origin, and does not stay there when S1 moves.
StretchFoundation::StretchFoundation(const StretchReference& stretch, FoundationLaw law) : law_(std::move(law)) {
  const CubicAxis rest(Vec2::Zero(), stretch.angles.front(), stretch.chord, stretch.angles.back());
  std::array<CubicAxis::Vector6, 2> ends_rate;
  ends_rate[0] << -stretch.chord_rate[0], stretch.angle_rate[0].front(), Vec2::Zero(), stretch.angle_rate[0].back();
  ends_rate[1] << Vec2::Zero(), stretch.angle_rate[1].front(), stretch.chord_rate[1], stretch.angle_rate[1].back();
  const GaussRule rule = gauss_rule(gauss_points);
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const double xi = 0.5 * (1.0 + rule.xi[g]);
    const CubicAxis::Place place = rest.at(xi);
    places_[g] = {.xi = xi,
                  .length = 0.5 * rule.weight[g] * stretch.length,
                  .at_rest = place.position,
                  .rest_rate = {place.gradient * ends_rate[0], place.gradient * ends_rate[1]}};
  }
  for (std::size_t end = 0; end < 2; ++end) growth_[end] = stretch.length_rate[end] / stretch.length;
}

StretchLoad::Response StretchFoundation::respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const {
  const CubicAxis now(r1, angle1, r2, angle2);
  StretchLoad::Response out;
  for (const Place& place : places_) {
    const CubicAxis::Place at = now.at(place.xi);
    const FoundationLaw::Response here = law_.at(at.position - place.at_rest);
    out.energy += place.length * here.energy;
    const Vec2 force = place.length * here.force, stiffness = place.length * here.stiffness;
    const StretchLoad::Vector6 gradient = at.gradient.transpose() * force;
    out.force += gradient;
    out.stiffness += at.gradient.transpose() * stiffness.asDiagonal() * at.gradient;
    now.add_second(place.xi, force, out.stiffness);
    for (std::size_t end = 0; end < 2; ++end)
      out.force_rate[end] +=
          growth_[end] * gradient - at.gradient.transpose() * stiffness.cwiseProduct(place.rest_rate[end]);
  }
  return out;
}

double StretchFoundation::evaluate(const Vec2& r1, double angle1, const Vec2& r2, double angle2,
                                   StretchLoad::Vector6* force, StretchLoad::Matrix6* stiffness) const {
  const CubicAxis now(r1, angle1, r2, angle2);
  CubicAxis::Sum sum(now);
  double energy = 0.0;
  for (const Place& place : places_) {
    const FoundationLaw::Response here = law_.at(sum.position(place.xi) - place.at_rest);
    energy += place.length * here.energy;
    if (force != nullptr || stiffness != nullptr) sum.add_slope(place.xi, place.length * here.force);
    if (stiffness != nullptr) sum.add_second(place.xi, place.length * here.stiffness);
  }
  if (force != nullptr) *force = sum.gradient();
  if (stiffness != nullptr) *stiffness = sum.hessian();
  return energy;
}

BeamFoundation::BeamFoundation(const StretchReference& stretch, FoundationLaw law)
    : along_(stretch, std::move(law)), chord_(stretch.chord), angles_{stretch.angles.front(), stretch.angles.back()} {}

double BeamFoundation::evaluate(const double* u, double* f, double* K) const {
  StretchLoad::Vector6 force;
  StretchLoad::Matrix6 stiffness;
  const double energy = along_.evaluate({u[0], u[1]}, angles_[0] + u[2], chord_ + Vec2(u[3], u[4]), angles_[1] + u[5],
                                        f != nullptr ? &force : nullptr, K != nullptr ? &stiffness : nullptr);
  if (f != nullptr) std::copy_n(force.data(), force.size(), f);
  if (K != nullptr) std::copy_n(stiffness.data(), stiffness.size(), K);
  return energy;
}

ExactFoundation::ExactFoundation(const ExactBeamReference& reference, FoundationLaw law, int unknowns_a_node)
    : law_(std::move(law)), nodes_(reference.order() + 1), stride_(unknowns_a_node) {
  const GaussRule rule = gauss_rule(gauss_points);
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const ShapeFunctions shape = shape_functions(reference.order(), rule.xi[g]);
    std::copy_n(shape.N.begin(), nodes_, places_[g].shape.begin());
    places_[g].length = rule.weight[g] * arc_speed(reference, shape);
  }
}

double ExactFoundation::evaluate(const double* u, double* f, double* K) const {
  const Index n = unknown_count();
  if (f != nullptr) std::fill(f, f + n, 0.0);
  if (K != nullptr) std::fill(K, K + n * n, 0.0);
  double V = 0.0;
  for (const auto& [shape, length] : places_) {
    Vec2 here = Vec2::Zero();
    for (std::size_t a = 0; a < static_cast<std::size_t>(nodes_); ++a)
      here += shape[a] * Eigen::Map<const Vec2>(u + static_cast<std::size_t>(stride_) * a);
    const FoundationLaw::Response at = law_.at(here);
    V += length * at.energy;
    for (Index a = 0; a < nodes_; ++a)
      for (Index direction = 0; direction < 2; ++direction) {
        const Index row = stride_ * a + direction;
        const double part = length * shape[static_cast<std::size_t>(a)];
        if (f != nullptr) f[row] += part * at.force[direction];
        for (Index b = 0; b < nodes_ && K != nullptr; ++b)
          K[row + n * (stride_ * b + direction)] += part * shape[static_cast<std::size_t>(b)] * at.stiffness[direction];
      }
  }
  return V;
}

}  // namespace arcwall
