#include "model/member_stretch.hpp"

#include <algorithm>
#include <cmath>

#include "core/unit_tangent.hpp"

namespace arcwall {

namespace {

// Forces differ, beyond what equilibrium leaves open.
bool jumps(const ShapePoint& before, const ShapePoint& behind, double force, double moment) {
  constexpr double relative = 1e-6;
  return std::abs(before.axial_force - behind.axial_force) > relative * force ||
         std::abs(before.moment - behind.moment) > relative * moment;
}

}  // namespace

double angle_near(const Vec2& v, double other) {
  return other + std::remainder(std::atan2(v.y(), v.x()) - other, 2.0 * pi);
}

// The derivatives at the ends are as long as an inextensible axis with an angle that is quadratic along it, to the
// second order in its slopes against the chord.
AxisCurve::AxisCurve(const Vec2& first, const Vec2& second, double angle1, double angle2)
    : first_(first), chord_(second - first), angle1_(angle1) {
  const double chord = angle_near(chord_, angle1);
  const double t1 = angle1 - chord, t2 = std::remainder(angle2 - chord, 2.0 * pi);
  const double bend = t2 - t1, skew = 3.0 * (t1 + t2);
  const double length = chord_.norm() * (1.0 + bend * bend / 24.0 + skew * skew / 360.0);
  derivative1_ = length * unit_tangent(angle1);
  derivative2_ = length * unit_tangent(angle2);
}

AxisCurve AxisCurve::reversed() const {
  AxisCurve curve = *this;
  curve.first_ = first_ + chord_;
  curve.chord_ = -chord_;
  curve.derivative1_ = -derivative2_;
  curve.derivative2_ = -derivative1_;
  curve.angle1_ = angle(1.0) + pi;
  return curve;
}

// The same cubic, with the derivatives by its part of ξ.
AxisCurve AxisCurve::part(double xi1, double xi2) const {
  AxisCurve curve;
  curve.first_ = position(xi1);
  curve.chord_ = position(xi2) - curve.first_;
  curve.derivative1_ = (xi2 - xi1) * derivative(xi1);
  curve.derivative2_ = (xi2 - xi1) * derivative(xi2);
  curve.angle1_ = angle(xi1);
  return curve;
}

Vec2 AxisCurve::position(double xi) const {
  const double x2 = xi * xi, x3 = x2 * xi;
  return first_ + (3.0 * x2 - 2.0 * x3) * chord_ + (xi - 2.0 * x2 + x3) * derivative1_ + (x3 - x2) * derivative2_;
}

Vec2 AxisCurve::integral_to(double xi) const {
  const double x2 = xi * xi, x3 = x2 * xi, x4 = x2 * x2;
  return xi * first_ + (x3 - 0.5 * x4) * chord_ + (0.5 * x2 - 2.0 / 3.0 * x3 + 0.25 * x4) * derivative1_ +
         (0.25 * x4 - x3 / 3.0) * derivative2_;
}

Vec2 AxisCurve::derivative(double xi) const {
  const double x2 = xi * xi;
  return 6.0 * (xi - x2) * chord_ + (1.0 - 4.0 * xi + 3.0 * x2) * derivative1_ + (3.0 * x2 - 2.0 * xi) * derivative2_;
}

double AxisCurve::angle(double xi) const { return angle_near(derivative(xi), angle1_); }

// What was behind a section is before it then.
MemberStretch MemberStretch::reversed() const {
  const auto of_other_part = [](const Resultant& one) { return Resultant{.force = -one.force, .moment = -one.moment}; };
  return {.from = to,
          .to = from,
          .now = now.reversed(),
          .rest = rest.reversed(),
          .first = of_other_part(second),
          .second = of_other_part(first)};
}

// With the force R = R1 + ξ (R2 − R1) the balance dM/dξ = −r′ × R gives
//
//   M(ξ) = M1 − (r − r1) × R1 − (ξ r − ∫ r dξ) × (R2 − R1)                                               (1)
double MemberStretch::balanced_moment(double xi) const {
  const Vec2 r = now.position(xi);
  return first.moment - cross(r - now.first(), first.force) -
         cross(xi * r - now.integral_to(xi), second.force - first.force);
}

double MemberStretch::axial_force(double xi) const {
  return ((1.0 - xi) * first.force + xi * second.force).dot(unit_tangent(now.angle(xi) - shear));
}

// What the interpolation leaves open at the second end is shared out evenly.
double MemberStretch::moment(double xi) const {
  return balanced_moment(xi) + xi * (second.moment - balanced_moment(1.0));
}

// Moments follow from the first end by balance; what that leaves open at the second end is shared out evenly.
void add_between_loads(const MemberStretch& whole, std::span<const PointLoadInside> loads,
                       std::vector<MemberStretch>& to) {
  if (loads.empty()) {
    to.push_back(whole);
    return;
  }
  Vec2 even = whole.first.force - whole.second.force;  // the load that is constant along the axis
  for (const PointLoadInside& load : loads) even -= load.force;
  const auto xi_of = [&](double place) { return std::clamp((place - whole.from) / (whole.to - whole.from), 0.0, 1.0); };
  const std::size_t first = to.size();
  Resultant carried = whole.first;
  double begin = whole.from;
  for (std::size_t i = 0; i <= loads.size(); ++i) {
    const double end = i < loads.size() ? std::clamp(loads[i].at, begin, whole.to) : whole.to;
    const double a = xi_of(begin), b = xi_of(end);
    if (a < b) {
      MemberStretch part{.from = begin, .to = end, .now = whole.now.part(a, b), .rest = whole.rest.part(a, b)};
      part.first = carried;
      part.second.force = carried.force - (b - a) * even;
      part.second.moment = part.balanced_moment(1.0);
      carried = part.second;
      to.push_back(part);
    }
    if (i < loads.size()) carried.force -= loads[i].force;
    begin = end;
  }
  const double open = whole.second.moment - carried.moment;
  for (std::size_t i = first; i < to.size(); ++i) {
    to[i].first.moment += xi_of(to[i].from) * open;
    to[i].second.moment += xi_of(to[i].to) * open;
  }
}

ShapePoint MemberStretch::at(double fraction) const {
  const double xi = std::clamp((fraction - from) / (to - from), 0.0, 1.0);
  const double angle = now.angle(xi) - shear;
  ShapePoint point{.fraction = fraction, .position = now.position(xi), .angle = angle};
  point.displacement = point.position - rest.position(xi);
  point.rotation = angle - (rest.angle(xi) - rest_shear);
  const Vec2 force = (1.0 - xi) * first.force + xi * second.force, along = unit_tangent(angle);
  point.axial_force = force.dot(along);
  point.shear_force = force.dot(Vec2(-along.y(), along.x()));
  point.moment = moment(xi);
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
