#include "contact/candidate.hpp"

namespace arcwall {

double Candidate::gap(const State& state) const {
  const Vec2 at = point_->position(state);
  return wall_->covers(at.x()) ? surface_slope(*wall_, side_, at).value : infinity;
}

void Candidate::gap(const State& state, Gap& out) const {
  PointKinematics at;
  point_->kinematics(state, at);
  const SurfaceGap g = surface_gap(*wall_, side_, at.position);
  out.value = g.value;
  out.gradient = g.x * at.jacobian.row(0).transpose() + g.z * at.jacobian.row(1).transpose();
  out.hessian = g.x * at.curvature[0] + g.z * at.curvature[1];
  out.hessian.noalias() += g.xx * at.jacobian.row(0).transpose() * at.jacobian.row(0);
  out.hessian.noalias() += g.xz * at.jacobian.row(0).transpose() * at.jacobian.row(1);
  out.hessian.noalias() += g.xz * at.jacobian.row(1).transpose() * at.jacobian.row(0);
}

double Candidate::gap_rate(const State& state, const Direction& direction) const {
  const PointMotion at = point_->motion(state, direction);
  if (!wall_->covers(at.position.x())) return 0.0;
  const SurfaceSlope g = surface_slope(*wall_, side_, at.position);
  return g.x * at.velocity.x() + g.z * at.velocity.y();
}

}  // namespace arcwall
