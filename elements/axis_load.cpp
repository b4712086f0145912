#include "elements/axis_load.hpp"

#include <algorithm>
#include <array>

#include "core/unit_tangent.hpp"
#include "elements/cubic_axis.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

namespace {

// Of the cubic through four equally spaced values on [0, 1].
double interpolated_angle(const std::array<double, StretchReference::samples>& values, double xi) {
  const double x = 3.0 * xi;
  return -(x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0 * values[0] + x * (x - 2.0) * (x - 3.0) / 2.0 * values[1] -
         x * (x - 1.0) * (x - 3.0) / 2.0 * values[2] + x * (x - 1.0) * (x - 2.0) / 6.0 * values[3];
}

}  // namespace

// Only the energy knows where the stretch is at rest.
StretchLoad::Response StretchAxisLoad::respond(const Vec2& r1, double angle1, const Vec2& r2, double angle2) const {
  const CubicAxis now(r1, angle1, r2, angle2);
  const CubicAxis rest(Vec2::Zero(), stretch_.angles.front(), stretch_.chord, stretch_.angles.back());
  StretchLoad::Response out;
  const GaussRule rule = gauss_rule(3);
  for (std::size_t g = 0; g < 3; ++g) {
    const double xi = 0.5 * (1.0 + rule.xi[g]), ds = 0.5 * rule.weight[g] * stretch_.length;
    const CubicAxis::Place at = now.at(xi);
    const Vec2 t = unit_tangent(interpolated_angle(stretch_.angles, xi));
    const Vec2 q = load_.x() * t + load_.y() * perp(t);
    const StretchLoad::Vector6 gradient = at.gradient.transpose() * q;
    out.energy -= ds * q.dot(at.position - rest.at(xi).position);
    out.force -= ds * gradient;
    now.add_second(xi, -ds * q, out.stiffness);
    for (std::size_t end = 0; end < 2; ++end)
      out.force_rate[end] -=
          ds * (stretch_.length_rate[end] / stretch_.length * gradient +
                interpolated_angle(stretch_.angle_rate[end], xi) * at.gradient.transpose() * perp(q));
  }
  return out;
}

}  // namespace arcwall
