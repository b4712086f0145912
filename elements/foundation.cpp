#include "elements/foundation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/cubic_place.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

namespace {

constexpr int gauss_points = 3;

using Ends = StretchLoad::Vector6;  // x, z and angle of the first end and of the second

}  // namespace

// At rest the first end is at the origin, and does not stay there when S1 moves.
StretchLoad::Response StretchFoundation::respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const {
  Ends now, rest;
  now << r1, angle1, r2, angle2;
  rest << Vec2::Zero(), stretch_.angles.front(), stretch_.chord, stretch_.angles.back();
  std::array<Ends, 2> rest_rate{Ends::Zero(), Ends::Zero()};
  rest_rate[0] << -stretch_.chord_rate[0], stretch_.angle_rate[0].front(), Vec2::Zero(), stretch_.angle_rate[0].back();
  rest_rate[1] << Vec2::Zero(), stretch_.angle_rate[1].front(), stretch_.chord_rate[1], stretch_.angle_rate[1].back();

  StretchLoad::Response out;
  const GaussRule rule = gauss_rule(gauss_points);
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const double xi = 0.5 * (1.0 + rule.xi[g]), ds = 0.5 * rule.weight[g] * stretch_.length;
    const CubicPlace at = cubic_place(now, xi), at_rest = cubic_place(rest, xi);
    const Vec2 u = at.position - at_rest.position, force = stiffness_.cwiseProduct(u);
    const StretchLoad::Vector6 gradient = at.gradient.transpose() * force;
    out.energy += 0.5 * ds * force.dot(u);
    out.force += ds * gradient;
    out.stiffness += ds * (at.gradient.transpose() * stiffness_.asDiagonal() * at.gradient + force[0] * at.second[0] +
                           force[1] * at.second[1]);
    for (std::size_t end = 0; end < 2; ++end)
      out.force_rate[end] +=
          ds * (stretch_.length_rate[end] / stretch_.length * gradient -
                at.gradient.transpose() * stiffness_.cwiseProduct(at_rest.gradient * rest_rate[end]));
  }
  return out;
}

ExactFoundation::ExactFoundation(const ExactBeamReference& reference, const Vec2& stiffness, int unknowns_a_node)
    : masses_(Matrix::Zero(reference.order() + 1, reference.order() + 1)),
      stiffness_(stiffness),
      stride_(unknowns_a_node) {
  const GaussRule rule = gauss_rule(gauss_points);
  for (std::size_t g = 0; g < gauss_points; ++g) {
    const ShapeFunctions shape = shape_functions(reference.order(), rule.xi[g]);
    const double ds = rule.weight[g] * arc_speed(reference, shape);
    const Eigen::Map<const Vector> N(shape.N.data(), masses_.rows());
    masses_ += ds * N * N.transpose();
  }
}

double ExactFoundation::evaluate(const double* u, double* f, double* K) const {
  const Index n = unknown_count(), nodes = masses_.rows();
  if (f != nullptr) std::fill(f, f + n, 0.0);
  if (K != nullptr) std::fill(K, K + n * n, 0.0);
  double V = 0.0;
  for (Index direction = 0; direction < 2; ++direction) {
    const Eigen::Map<const Vector, 0, Eigen::InnerStride<>> along(u + direction, nodes, Eigen::InnerStride<>(stride_));
    const Vector force = stiffness_[direction] * masses_ * along;
    V += 0.5 * force.dot(along);
    for (Index a = 0; a < nodes; ++a) {
      const Index row = stride_ * a + direction;
      if (f != nullptr) f[row] = force[a];
      for (Index b = 0; b < nodes && K != nullptr; ++b)
        K[row + n * (stride_ * b + direction)] = stiffness_[direction] * masses_(a, b);
    }
  }
  return V;
}

}  // namespace arcwall
