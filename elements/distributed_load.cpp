#include "elements/distributed_load.hpp"

#include <algorithm>

namespace arcwall {

double BeamDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  const double h = reference_.length;
  const Vec2 chord = reference_.chord + Vec2(u[3] - u[0], u[4] - u[1]);
  const double bend = (reference_.slope1 - reference_.slope2 + u[2] - u[5]) / 12.0;
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

double TrussDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  if (f != nullptr) {
    f[0] = f[2] = -0.5 * resultant_.x();
    f[1] = f[3] = -0.5 * resultant_.y();
  }
  if (K != nullptr) std::fill(K, K + 16, 0.0);
  return -0.5 * (resultant_.x() * (u[0] + u[2]) + resultant_.y() * (u[1] + u[3]));
}

}  // namespace arcwall
