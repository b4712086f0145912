#include "contact/candidate.hpp"

#include <cmath>

namespace arcwall {

double Candidate::gap(const State& state) const {
  return obstacle_->gap_slope(point_->position(state), state.lambda).value;
}

namespace {

// A field of the obstacle where the point is, by the point's unknowns and λ: both the obstacle and the point may move
// with λ.
void at_point(const QuadraticField& g, const PointKinematics& at, Gap& out) {
  const auto by_x = at.jacobian.row(0), by_z = at.jacobian.row(1);
  out.value = g.value;
  out.gradient = g.x * by_x.transpose() + g.z * by_z.transpose();
  out.hessian = g.x * at.curvature[0] + g.z * at.curvature[1];
  out.hessian.noalias() += g.xx * by_x.transpose() * by_x;
  out.hessian.noalias() += g.xz * by_x.transpose() * by_z;
  out.hessian.noalias() += g.xz * by_z.transpose() * by_x;
  out.hessian.noalias() += g.zz * by_z.transpose() * by_z;
  const double x_rate = at.rate.x(), z_rate = at.rate.y();
  out.rate = g.rate + g.x * x_rate + g.z * z_rate;
  out.gradient_rate = (g.x_rate + g.xx * x_rate + g.xz * z_rate) * by_x.transpose();
  out.gradient_rate += (g.z_rate + g.xz * x_rate + g.zz * z_rate) * by_z.transpose();
  out.gradient_rate += g.x * at.jacobian_rate.row(0).transpose() + g.z * at.jacobian_rate.row(1).transpose();
}

}  // namespace

void Candidate::gap(const State& state, Gap& out) const {
  PointKinematics at;
  point_->kinematics(state, at);
  at_point(obstacle_->gap(at.position, state.lambda), at, out);
}

QuadraticField Candidate::place_field(const Vec2& position, double lambda) const {
  const double sign = sign_of(obstacle_->side());
  QuadraticField place = obstacle_->arc_length(position, lambda);
  for (double* part :
       {&place.value, &place.x, &place.z, &place.xx, &place.xz, &place.zz, &place.rate, &place.x_rate, &place.z_rate})
    *part *= sign;
  return place;
}

void Candidate::place(const State& state, double near, Gap& out) const {
  PointKinematics at;
  rubbing_point().kinematics(state, at);
  at_point(place_field(at.position, state.lambda), at, out);
  for (const double round : {obstacle_->round_length(), 2.0 * pi * obstacle_->half_height()})  // that of its direction
    if (round > 0.0) out.value += round * std::round((near - out.value) / round);
}

Vec2 Candidate::tangent(const State& state) const {
  const QuadraticField place = place_field(rubbing_point().position(state), state.lambda);
  return Vec2(place.x, place.z).normalized();
}

double Candidate::gap_rate(const State& state, const Direction& direction) const {
  const PointMotion at = point_->motion(state, direction);
  const LinearField g = obstacle_->gap_slope(at.position, state.lambda);
  return g.x * at.velocity.x() + g.z * at.velocity.y() + g.rate * direction.dlambda;
}

}  // namespace arcwall
