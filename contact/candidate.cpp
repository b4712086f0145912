#include "contact/candidate.hpp"

#include <cmath>

namespace arcwall {

double Candidate::gap(const Vector& x) const {
  const Vec2 at = point_->position(x);
  if (!wall_->covers(at.x())) return infinity;
  const Height psi = wall_->at(at.x());
  return (side_ == Side::below ? 1.0 : -1.0) * (at.y() - psi.value) / std::sqrt(1.0 + psi.first * psi.first);
}

// g = ± d c with d = z − ψ, c = (1 + ψ′²)^(−½):  c′ = −ψ′ψ″ c³,  c″ = −(ψ″² + ψ′ψ‴) c³ + 3 (ψ′ψ″)² c⁵
//
//   g_x = ±(d c′ − ψ′ c),  g_z = ± c,  g_xx = ±(d c″ − 2 ψ′ c′ − ψ″ c),  g_xz = ± c′,  g_zz = 0
void Candidate::gap(const Vector& x, Gap& out) const {
  PointKinematics at;
  point_->kinematics(x, at);
  const Height psi = wall_->at(at.position.x());
  const double sign = side_ == Side::below ? 1.0 : -1.0;
  const double c = 1.0 / std::sqrt(1.0 + psi.first * psi.first), c3 = c * c * c, bend = psi.first * psi.second;
  const double c1 = -bend * c3;
  const double c2 = -(psi.second * psi.second + psi.first * psi.third) * c3 + 3.0 * bend * bend * c3 * c * c;
  const double d = at.position.y() - psi.value;
  const double g_x = sign * (d * c1 - psi.first * c), g_z = sign * c;
  const double g_xx = sign * (d * c2 - 2.0 * psi.first * c1 - psi.second * c), g_xz = sign * c1;

  out.value = sign * d * c;
  out.gradient = g_x * at.jacobian.row(0).transpose() + g_z * at.jacobian.row(1).transpose();
  out.hessian = g_x * at.curvature[0] + g_z * at.curvature[1];
  out.hessian.noalias() += g_xx * at.jacobian.row(0).transpose() * at.jacobian.row(0);
  out.hessian.noalias() += g_xz * at.jacobian.row(0).transpose() * at.jacobian.row(1);
  out.hessian.noalias() += g_xz * at.jacobian.row(1).transpose() * at.jacobian.row(0);
}

double Candidate::gap_rate(const Vector& x, const Vector& dx) const {
  if (!faces_wall(x)) return 0.0;
  Gap gap_here;
  gap(x, gap_here);
  double rate = 0.0;
  for (std::size_t i = 0; i < point_->unknowns().size(); ++i)
    rate += gap_here.gradient[static_cast<Index>(i)] * dx[point_->unknowns()[i]];
  return rate;
}

}  // namespace arcwall
