#include "elements/pressure.hpp"

#include <algorithm>

#include "elements/chord_frame.hpp"

namespace arcwall {

// With b = φ1 − φ2 and J r = perp(r): ∂V/∂r1 = ½ J r2 − b c/6, ∂V/∂r2 = −½ J r1 + b c/6, ∂V/∂φ1 = |c|²/12 = −∂V/∂φ2.
StretchLoad::Response pressure_on_stretch(const Vec2& r1, double angle1, const Vec2& r2, double angle2) {
  const Vec2 c = r2 - r1;
  const double bend = within_half_a_turn(angle1 - angle2), square = c.squaredNorm();
  StretchLoad::Response out{.energy = -0.5 * cross(r1, r2) + square * bend / 12.0};
  out.force << 0.5 * perp(r2) - bend / 6.0 * c, square / 12.0, -0.5 * perp(r1) + bend / 6.0 * c, -square / 12.0;
  Eigen::Matrix2d J;
  J << 0.0, -1.0, 1.0, 0.0;
  const Eigen::Matrix2d stretching = bend / 6.0 * Eigen::Matrix2d::Identity();
  out.stiffness.block<2, 2>(0, 0) = out.stiffness.block<2, 2>(3, 3) = stretching;
  out.stiffness.block<2, 2>(0, 3) = 0.5 * J - stretching;
  out.stiffness.block<2, 2>(3, 0) = out.stiffness.block<2, 2>(0, 3).transpose();
  for (const Index rotation : {2, 5})
    for (const Index end : {0, 3}) {
      const Vec2 coupling = ((rotation == 2) == (end == 0) ? -1.0 : 1.0) / 6.0 * c;
      out.stiffness.block<2, 1>(end, rotation) = coupling;
      out.stiffness.block<1, 2>(rotation, end) = coupling.transpose();
    }
  return out;
}

double BeamPressure::evaluate(const double* u, double* f, double* K) const {
  const Vec2 second = first_ + reference_.chord;
  const auto now = pressure_on_stretch(first_ + Vec2(u[0], u[1]), reference_.slope1 + u[2], second + Vec2(u[3], u[4]),
                                       reference_.slope2 + u[5]);
  if (f != nullptr) std::copy_n(now.force.data(), now.force.size(), f);
  if (K != nullptr) std::copy_n(now.stiffness.data(), now.stiffness.size(), K);
  return now.energy - pressure_on_stretch(first_, reference_.slope1, second, reference_.slope2).energy;
}

void BeamPressure::complete_end_forces(const double* u, double /*lambda*/, double* f) const {
  const Vec2 at_first = pressure_at_end(first_ + Vec2(u[0], u[1]));
  const Vec2 at_second = pressure_at_end(first_ + reference_.chord + Vec2(u[3], u[4]));
  for (int i = 0; i < 2; ++i) {
    f[i] -= at_first[i];
    f[3 + i] += at_second[i];
  }
}

// ∫ (N_a N_b′ − N_b N_a′) dξ of the shape functions of order 1 and 2.
ExactPressure::ExactPressure(const ExactBeamReference& reference, const Vec2& first, int unknowns_a_node)
    : stride_(unknowns_a_node) {
  for (const Vec2& node : reference.nodes) places_.push_back(first + node);
  if (reference.order() == 1) {
    pairs_ = {{.a = 0, .b = 1, .weight = 1.0}};
  } else {
    pairs_ = {{.a = 0, .b = 1, .weight = 4.0 / 3.0},
              {.a = 1, .b = 2, .weight = 4.0 / 3.0},
              {.a = 0, .b = 2, .weight = -1.0 / 3.0}};
  }
}

Vec2 ExactPressure::place(const double* u, std::size_t node) const {
  const double* at = u + static_cast<std::size_t>(stride_) * node;
  return places_[node] + Vec2(at[0], at[1]);
}

double ExactPressure::evaluate(const double* u, double* f, double* K) const {
  const auto n = static_cast<std::size_t>(unknown_count()), stride = static_cast<std::size_t>(stride_);
  if (f != nullptr) std::fill(f, f + n, 0.0);
  if (K != nullptr) std::fill(K, K + n * n, 0.0);
  double V = 0.0;
  for (const auto& [a, b, weight] : pairs_) {
    const Vec2 first = place(u, a), second = place(u, b);
    const std::size_t i = stride * a, j = stride * b;
    V -= 0.5 * weight * (cross(first, second) - cross(places_[a], places_[b]));
    if (f != nullptr) {
      f[i] -= 0.5 * weight * second.y();
      f[i + 1] += 0.5 * weight * second.x();
      f[j] += 0.5 * weight * first.y();
      f[j + 1] -= 0.5 * weight * first.x();
    }
    if (K != nullptr) {
      K[j + n * (i + 1)] += 0.5 * weight;
      K[j + 1 + n * i] -= 0.5 * weight;
    }
  }
  return V;
}

void ExactPressure::complete_end_forces(const double* u, double /*lambda*/, double* f) const {
  const std::size_t last = places_.size() - 1, second = static_cast<std::size_t>(stride_) * last;
  const Vec2 at_first = pressure_at_end(place(u, 0)), at_second = pressure_at_end(place(u, last));
  for (std::size_t i = 0; i < 2; ++i) {
    f[i] -= at_first[static_cast<Index>(i)];
    f[second + i] += at_second[static_cast<Index>(i)];
  }
}

}  // namespace arcwall
