#include "apps/output/member_stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace arcwall {

namespace {

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double angle_of(const Vec2& v, double near) { return near + std::remainder(std::atan2(v.y(), v.x()) - near, 2.0 * pi); }

// Derivatives of the cubic at its ends: as long as an inextensible axis with an angle that is quadratic along it, to
// the second order in its slopes against the chord.
std::array<Vec2, 2> end_derivatives(const AxisCurve& curve) {
  const double chord = curve.chord_angle();
  const double t1 = curve.angle1 - chord, t2 = std::remainder(curve.angle2 - chord, 2.0 * pi);
  const double bend = t2 - t1, skew = 3.0 * (t1 + t2);
  const double length = (curve.second - curve.first).norm() * (1.0 + bend * bend / 24.0 + skew * skew / 360.0);
  return {length * direction(curve.angle1), length * direction(curve.angle2)};
}

// Forces differ, beyond what equilibrium leaves open.
bool jumps(const ShapePoint& before, const ShapePoint& behind, double force, double moment) {
  constexpr double relative = 1e-6;
  return std::abs(before.axial_force - behind.axial_force) > relative * force ||
         std::abs(before.moment - behind.moment) > relative * moment;
}

}  // namespace

double AxisCurve::chord_angle() const { return angle_of(second - first, angle1); }

Vec2 AxisCurve::position(double xi) const {
  const auto [d1, d2] = end_derivatives(*this);
  const double x2 = xi * xi, x3 = x2 * xi, h = 3.0 * x2 - 2.0 * x3;
  return first + h * (second - first) + (xi - 2.0 * x2 + x3) * d1 + (x3 - x2) * d2;
}

double AxisCurve::angle(double xi) const {
  const auto [d1, d2] = end_derivatives(*this);
  const double x2 = xi * xi;
  return angle_of(6.0 * (xi - x2) * (second - first) + (1.0 - 4.0 * xi + 3.0 * x2) * d1 + (3.0 * x2 - 2.0 * xi) * d2,
                  angle1);
}

Vec2 AxisCurve::integral_to(double xi) const {
  const auto [d1, d2] = end_derivatives(*this);
  const double x2 = xi * xi, x3 = x2 * xi, x4 = x2 * x2, h = x3 - 0.5 * x4;
  return xi * first + h * (second - first) + (0.5 * x2 - 2.0 / 3.0 * x3 + 0.25 * x4) * d1 + (0.25 * x4 - x3 / 3.0) * d2;
}

// With the force R = R1 + ξ (R2 − R1) the balance dM/dξ = −r′ × R gives
//
//   M(ξ) = M1 − (r − r1) × R1 − (ξ r − ∫ r dξ) × (R2 − R1)                                               (1)
double MemberStretch::balanced_moment(double xi) const {
  const Vec2 r = now.position(xi);
  return first.moment - cross(r - now.first, first.force) -
         cross(xi * r - now.integral_to(xi), second.force - first.force);
}

// What the interpolation leaves open at the second end is shared out evenly.
ShapePoint MemberStretch::at(double fraction) const {
  const double xi = std::clamp((fraction - from) / (to - from), 0.0, 1.0);
  const auto section = [xi](const AxisCurve& curve, const std::array<double, 2>& against) {
    return curve.angle(xi) - (1.0 - xi) * against[0] - xi * against[1];
  };
  const double angle = section(now, shear);
  ShapePoint point{.fraction = fraction, .position = now.position(xi)};
  point.displacement = point.position - rest.position(xi);
  point.rotation = angle - section(rest, rest_shear);
  point.axial_force = ((1.0 - xi) * first.force + xi * second.force).dot(direction(angle));
  point.moment = balanced_moment(xi) + xi * (second.moment - balanced_moment(1.0));
  return point;
}

std::vector<ShapePoint> sampled(std::span<const MemberStretch> stretches, std::span<const double> fractions) {
  constexpr double same = 1e-12;
  double force = 0.0, moment = 0.0;
  for (const MemberStretch& stretch : stretches) {
    force = std::max({force, stretch.first.force.norm(), stretch.second.force.norm()});
    moment = std::max({moment, std::abs(stretch.first.moment), std::abs(stretch.second.moment)});
  }
  std::vector<ShapePoint> points;
  points.reserve(fractions.size());
  auto here = stretches.begin();
  for (const double fraction : fractions) {
    while (here + 1 != stretches.end() && here->to < fraction - same) ++here;
    points.push_back(here->at(fraction));
    const auto next = here + 1;
    if (next == stretches.end() || std::abs(here->to - fraction) > same) continue;
    if (const ShapePoint behind = next->at(fraction); jumps(points.back(), behind, force, moment))
      points.push_back(behind);
  }
  return points;
}

}  // namespace arcwall
