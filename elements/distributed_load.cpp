#include "elements/distributed_load.hpp"

#include <algorithm>

#include "elements/chord_frame.hpp"

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

double BeamDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  const double h = reference_.length;
  const Vec2 chord = reference_.chord + Vec2(u[3] - u[0], u[4] - u[1]);
  const double bend = within_half_a_turn(reference_.slope1 - reference_.slope2 + u[2] - u[5]) / 12.0;
  const double bend_0 = (reference_.slope1 - reference_.slope2) / 12.0;
  // q·Δr⊥ = q_z Δx − q_x Δz
  const double across = load_.y() * chord.x() - load_.x() * chord.y();
  const double across_0 = load_.y() * reference_.chord.x() - load_.x() * reference_.chord.y();
  const double mean = 0.5 * (load_.x() * (u[0] + u[3]) + load_.y() * (u[1] + u[4]));
  if (f != nullptr) {
    f[0] = -h * (0.5 * load_.x() - load_.y() * bend);
    f[1] = -h * (0.5 * load_.y() + load_.x() * bend);
    f[2] = -h * across / 12.0;
    f[3] = -h * (0.5 * load_.x() + load_.y() * bend);
    f[4] = -h * (0.5 * load_.y() - load_.x() * bend);
    f[5] = h * across / 12.0;
  }
  if (K != nullptr) {
    std::fill(K, K + 36, 0.0);
    const double x = h * load_.y() / 12.0, z = h * load_.x() / 12.0;  // ∂²V between rotations and translations
    K[2 + 6 * 0] = x;
    K[2 + 6 * 1] = -z;
    K[3 + 6 * 2] = -x;
    K[4 + 6 * 2] = z;
    K[5 + 6 * 0] = -x;
    K[5 + 6 * 1] = z;
    K[5 + 6 * 3] = x;
    K[5 + 6 * 4] = -z;
  }
  return -h * (mean + across * bend - across_0 * bend_0);
}

// With q⊥ = (q_z, −q_x): q·Δr⊥ = q⊥·Δr.
StretchLoad::Response StretchLoad::respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const {
  const double h = length_, bend = within_half_a_turn(angle1 - angle2) / 12.0;
  const Vec2 turned(load_.y(), -load_.x());
  const double across = turned.dot(r2 - r1);
  Response out{.energy = -h * (0.5 * load_.dot(r1 + r2) + across * bend)};
  out.force << -h * (0.5 * load_ - bend * turned), -h * across / 12.0, -h * (0.5 * load_ + bend * turned),
      h * across / 12.0;
  const Vec2 coupling = h / 12.0 * turned;
  for (const Index rotation : {2, 5})
    for (const Index end : {0, 3}) {
      const double sign = (rotation == 2) == (end == 0) ? 1.0 : -1.0;
      out.stiffness.block<2, 1>(end, rotation) = sign * coupling;
      out.stiffness.block<1, 2>(rotation, end) = sign * coupling.transpose();
    }
  for (std::size_t i = 0; i < 2; ++i) out.force_rate[i] = length_rate_[i] / h * out.force;
  return out;
}

double TrussDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  if (f != nullptr) {
    f[0] = f[2] = -0.5 * resultant_.x();
    f[1] = f[3] = -0.5 * resultant_.y();
  }
  if (K != nullptr) std::fill(K, K + 16, 0.0);
  return -0.5 * (resultant_.x() * (u[0] + u[2]) + resultant_.y() * (u[1] + u[3]));
}

}  // namespace arcwall
