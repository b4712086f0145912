#include "apps/verify/plain_wall.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <variant>

#include "apps/verify/plain_knot.hpp"
#include "core/unit_tangent.hpp"
#include "model/build_contact.hpp"

namespace arcwall::verify {

namespace {

// Second derivatives at the knots of the cubic spline through the points, not-a-knot at both ends: the third derivative
// is continuous at the second knot and at the last but one. A line through two points, a parabola through three.
std::vector<double> spline_second_derivatives(const std::vector<double>& x, const std::vector<double>& z) {
  const auto n = static_cast<Index>(x.size());
  Matrix A = Matrix::Zero(n, n);
  Vector b = Vector::Zero(n);
  const auto width = [&](Index i) { return x[static_cast<std::size_t>(i + 1)] - x[static_cast<std::size_t>(i)]; };
  const auto slope = [&](Index i) {
    return (z[static_cast<std::size_t>(i + 1)] - z[static_cast<std::size_t>(i)]) / width(i);
  };
  for (Index i = 1; i + 1 < n; ++i) {
    A.row(i).segment<3>(i - 1) << width(i - 1) / 6.0, (width(i - 1) + width(i)) / 3.0, width(i) / 6.0;
    b[i] = slope(i) - slope(i - 1);
  }
  if (n <= 3) {  // all alike
    A(0, 0) = A(n - 1, n - 1) = 1.0;
    if (n == 3) A(0, 1) = A(2, 1) = -1.0;
  } else {
    A.row(0).head<3>() << -1.0 / width(0), 1.0 / width(0) + 1.0 / width(1), -1.0 / width(1);
    A.row(n - 1).tail<3>() << -1.0 / width(n - 3), 1.0 / width(n - 3) + 1.0 / width(n - 2), -1.0 / width(n - 2);
  }
  const Vector second = Eigen::FullPivLU<Matrix>(A).solve(b);
  return {second.begin(), second.end()};
}

}  // namespace

PlainWall::PlainWall(const deck::Wall& wall) : wall_(wall) {
  if (const auto* spline = std::get_if<deck::SplineProfile>(&wall.profile))
    second_ = spline_second_derivatives(spline->x, spline->z);
  if (wall.outline) outline_ = std::make_shared<PlainOutline>(wall);
}

// Rigid bodies turn about a point that has gone its way: r = c + λ w + R(λ α) (q − c).
Vec2 PlainWall::at_rest(const Vec2& point) const {
  if (!wall_.motion) return point;
  const deck::WallMotion& motion = *wall_.motion;
  const Vec2 centre(motion.about.x, motion.about.z), way = progress_ * Vec2(motion.x, motion.z);
  const double c = std::cos(turned()), s = std::sin(turned());
  const Vec2 arm = point - centre - way;
  return centre + Vec2(c * arm.x() + s * arm.y(), c * arm.y() - s * arm.x());
}

bool PlainWall::faces(const Vec2& point) const {
  if (outline_) return !outline_->nearest(at_rest(point)).beyond;
  const double x = at_rest(point).x();
  if (const auto* circle = std::get_if<deck::CircleProfile>(&wall_.profile))
    return std::abs(x - circle->centre.x) < circle->radius * (1.0 - 1e-6);
  if (const auto* spline = std::get_if<deck::SplineProfile>(&wall_.profile))
    return x >= spline->x.front() && x <= spline->x.back();
  return true;
}

PlainWall::Surface PlainWall::surface(double x) const {
  if (const auto* flat = std::get_if<deck::FlatProfile>(&wall_.profile)) return {flat->z, 0.0, 0.0};
  if (const auto* line = std::get_if<deck::LineProfile>(&wall_.profile))
    return {line->z + line->slope * x, line->slope, 0.0};
  if (const auto* parabola = std::get_if<deck::ParabolaProfile>(&wall_.profile)) {
    const double d = x - parabola->apex.x, c = parabola->curvature;
    return {parabola->apex.z + 0.5 * c * d * d, c * d, c};
  }
  if (const auto* circle = std::get_if<deck::CircleProfile>(&wall_.profile)) {
    // (x − x₀)² + (z − z₀)² = R²: z′ = −(x − x₀)/(z − z₀), z″ = −(1 + z′²)/(z − z₀)
    const double d = x - circle->centre.x;
    const double up = side() * std::sqrt((circle->radius - d) * (circle->radius + d)), slope = -d / up;
    return {circle->centre.z + up, slope, -(1.0 + slope * slope) / up};
  }
  const auto& spline = std::get<deck::SplineProfile>(wall_.profile);
  const auto above = std::upper_bound(spline.x.begin() + 1, spline.x.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - spline.x.begin()) - 1;
  const double h = spline.x[i + 1] - spline.x[i], a = (spline.x[i + 1] - x) / h, b = (x - spline.x[i]) / h;
  const double m = second_[i], n = second_[i + 1];
  Surface here{a * spline.z[i] + b * spline.z[i + 1] + h * h / 6.0 * ((a * a * a - a) * m + (b * b * b - b) * n),
               (spline.z[i + 1] - spline.z[i]) / h + h / 6.0 * ((1.0 - 3.0 * a * a) * m + (3.0 * b * b - 1.0) * n),
               a * m + b * n};
  const std::size_t knot = b < 0.5 ? i : i + 1;
  if (knot == 0 || knot + 1 == spline.x.size()) return here;
  const double before = spline.x[knot] - spline.x[knot - 1], behind = spline.x[knot + 1] - spline.x[knot];
  const double jump = (second_[knot + 1] - second_[knot]) / behind - (second_[knot] - second_[knot - 1]) / before;
  const RoundedKnot more = rounded_knot(x - spline.x[knot], std::min(before, behind));
  here.height += jump * more.value;
  here.slope += jump * more.slope;
  here.second += jump * more.second;
  return here;
}

// dκ/ds = z‴/(1 + z′²)² and more, which is continuous.
std::vector<PlainWall::RateJump> PlainWall::rate_jumps() const {
  std::vector<RateJump> jumps;
  const auto* spline = std::get_if<deck::SplineProfile>(&wall_.profile);
  if (outline_ || spline == nullptr) return jumps;
  const auto third = [&](std::size_t i) { return (second_[i + 1] - second_[i]) / (spline->x[i + 1] - spline->x[i]); };
  for (std::size_t i = 1; i + 1 < spline->x.size(); ++i) {
    const double slope = surface(spline->x[i]).slope, w = 1.0 + slope * slope;
    jumps.push_back({.x = spline->x[i], .jump = (third(i) - third(i - 1)) / (w * w)});
  }
  return jumps;
}

double PlainWall::slope_angle(const Vec2& point) const {
  if (outline_) return outline_->nearest(at_rest(point)).angle + turned();
  return std::atan(surface(at_rest(point).x()).slope) + turned();
}

double PlainWall::curvature(const Vec2& point) const {
  if (outline_) {
    const Vec2 seen = at_rest(point);
    return outline_->nearest(seen + beside_ * unit_tangent(outline_->nearest(seen).angle)).curvature;
  }
  const Surface here = surface(at_rest(point).x());
  return here.second / std::pow(1.0 + here.slope * here.slope, 1.5);
}

bool PlainWall::bends_anew(const Vec2& point, double within) const {
  const bool has_arcs = outline_ && std::holds_alternative<deck::PolylineOutline>(*wall_.outline);
  return has_arcs && curved_as_beside(within).curvature(point) != curved_as_beside(-within).curvature(point);
}

double PlainWall::gap(const Vec2& point) const {
  if (outline_) return outline_->nearest(at_rest(point)).distance;
  const Vec2 seen = at_rest(point);
  const Surface here = surface(seen.x());
  return side() * (seen.y() - here.height) * std::cos(std::atan(here.slope));
}

double PlainWall::width() const {
  if (outline_) return outline_->width();
  if (const auto* circle = std::get_if<deck::CircleProfile>(&wall_.profile)) return 2.0 * circle->radius;
  if (const auto* parabola = std::get_if<deck::ParabolaProfile>(&wall_.profile))
    return parabola->curvature != 0.0 ? 2.0 / std::abs(parabola->curvature) : infinity;
  const auto* spline = std::get_if<deck::SplineProfile>(&wall_.profile);
  if (spline == nullptr) return infinity;
  double least = infinity;  // between two knots there is one bend
  for (std::size_t i = 1; i < spline->x.size(); ++i) least = std::min(least, spline->x[i] - spline->x[i - 1]);
  return least;
}

double PlainWall::from_vertical(const Vec2& point) const {
  const auto* circle = std::get_if<deck::CircleProfile>(&wall_.profile);
  if (outline_ || circle == nullptr) return infinity;
  return std::abs(circle->radius - std::abs(at_rest(point).x() - circle->centre.x));
}

bool PlainWall::concerns(const std::string& member) const {
  return wall_.members.empty() || std::find(wall_.members.begin(), wall_.members.end(), member) != wall_.members.end();
}

std::vector<PlainWall> walls_at(const std::vector<PlainWall>& walls, double lambda) {
  std::vector<PlainWall> moved;
  for (const PlainWall& wall : walls) moved.push_back(wall.at(lambda));
  return moved;
}

Vec2 PlainWall::normal(const Vec2& point) const {
  return faces(point) ? Vec2(perp(unit_tangent(slope_angle(point)))) : Vec2(Vec2::Zero());
}

// 1/(1/κ − d), so that a sharp corner, of which κ is infinite, turns by −1/d.
double PlainWall::turn(const Vec2& point) const {
  const double bend = faces(point) ? curvature(point) : 0.0;
  return bend == 0.0 ? 0.0 : 1.0 / (1.0 / bend - gap(point));
}

Vec2 PlainWall::touched_by(const Vec2& point, double half_height) const {
  const double off = kept_off(half_height);
  return off > 0.0 && faces(point) ? Vec2(point - off * perp(unit_tangent(slope_angle(point)))) : point;
}

std::vector<PlainWall> walls_of(const deck::Deck& deck) {
  std::vector<PlainWall> walls;
  for (const deck::Wall& wall : walls_in_parts(deck)) walls.emplace_back(wall);
  return walls;
}

const PlainWall& wall_of(const std::vector<PlainWall>& walls, const std::string& name) {
  return *std::find_if(walls.begin(), walls.end(), [&](const PlainWall& wall) { return wall.deck().name == name; });
}

}  // namespace arcwall::verify
