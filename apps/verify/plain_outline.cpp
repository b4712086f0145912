#include "apps/verify/plain_outline.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "apps/verify/plain_knot.hpp"

namespace arcwall::verify {

namespace {

double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

double area(const std::vector<Vec2>& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  return sum;
}

// Points of a closed outline so that the body is to the left.
std::vector<Vec2> in_order(const deck::OutlinePoints& outline) {
  std::vector<Vec2> points = outline.points();
  const bool runs_right = (area(points) > 0.0) == (outline.keep == Keep::inside);
  if (outline.closed && !runs_right) std::reverse(points.begin(), points.end());
  return points;
}

// Where the lines through p along a and through q along b meet.
Vec2 meeting(const Vec2& p, const Vec2& a, const Vec2& q, const Vec2& b) {
  Eigen::Matrix2d both;
  both << a, -b;
  return p + a * (both.inverse() * (q - p)).x();
}

}  // namespace

PlainOutline::PlainOutline(const deck::Wall& wall) : outline_(*wall.outline) {
  if (const auto* circle = std::get_if<deck::CircleOutline>(&outline_)) width_ = 2.0 * circle->radius;
  if (const auto* ellipse = std::get_if<deck::EllipseOutline>(&outline_)) {
    const auto [least, most] = std::minmax(ellipse->axes.x, ellipse->axes.z);
    width_ = 2.0 * least * least / most;  // of the circle in its sharp ends
  }
  if (const auto* polyline = std::get_if<deck::PolylineOutline>(&outline_)) {
    is_closed_ = polyline->closed;
    stays_outside_ = polyline->keep == Keep::outside;
    std::vector<double> radii = wall.radii();
    const std::vector<Vec2> corners = in_order(*polyline);
    if (corners.front() != polyline->points().front()) std::reverse(radii.begin(), radii.end());
    make_parts(corners, radii, is_closed_);
  }
  if (const auto* curve = std::get_if<deck::CurveOutline>(&outline_)) {
    is_closed_ = curve->closed;
    stays_outside_ = curve->keep == Keep::outside;
    make_curve(in_order(*curve), is_closed_);
  }
}

PlainOutline::Nearest PlainOutline::nearest(const Vec2& point) const {
  if (const auto* plane = std::get_if<deck::HalfPlaneOutline>(&outline_)) {
    const double angle = std::atan2(-plane->normal.x, plane->normal.z);
    const Vec2 arm = point - Vec2(plane->point.x, plane->point.z);
    return {.distance = arm.y() * std::cos(angle) - arm.x() * std::sin(angle), .angle = angle};
  }
  if (const auto* circle = std::get_if<deck::CircleOutline>(&outline_)) {
    const Vec2 arm = point - Vec2(circle->centre.x, circle->centre.z);
    const double outside = circle->keep == Keep::outside ? 1.0 : -1.0;
    return {.distance = outside * (std::hypot(arm.x(), arm.y()) - circle->radius),
            .angle = angle_of(arm) - outside * 0.5 * pi,
            .curvature = -outside / circle->radius};
  }
  if (const auto* ellipse = std::get_if<deck::EllipseOutline>(&outline_)) return nearest_of_ellipse(*ellipse, point);
  // A polyline or a curve: any other kind needs a case above.
  return parts_.empty() ? nearest_of_curve(point) : nearest_of_parts(point);
}

// From the middle of each line, or between each two points of a curve, inwards as long as what is left is nearest.
std::optional<Vec2> PlainOutline::innermost() const {
  struct Line {
    Vec2 middle, along;
    double length;
  };
  std::vector<Line> lines;
  for (const Part& part : parts_)
    if (const Vec2 side = part.to - part.from; !part.is_arc && !side.isZero(0.0))
      lines.push_back({.middle = 0.5 * (part.from + part.to), .along = side.normalized(), .length = side.norm()});
  for (std::size_t i = 0; i + 1 < at_.size(); ++i) {
    const OnCurve on = on_curve(0.5 * (at_[i] + at_[i + 1]));
    lines.push_back({.middle = on.p, .along = on.first.normalized(), .length = at_[i + 1] - at_[i]});
  }
  if (const auto* circle = std::get_if<deck::CircleOutline>(&outline_); circle && circle->keep == Keep::outside)
    return Vec2(circle->centre.x, circle->centre.z);
  if (const auto* ellipse = std::get_if<deck::EllipseOutline>(&outline_); ellipse && ellipse->keep == Keep::outside)
    return Vec2(ellipse->centre.x, ellipse->centre.z);
  if (is_closed_ && !stays_outside_) return std::nullopt;
  double whole = 0.0, depth = 0.0;
  for (const Line& line : lines) whole += line.length;
  std::optional<Vec2> deepest;
  for (const Line& line : lines)
    for (double far = line.length / 64.0; far <= whole; far *= 2.0) {
      const Vec2 place = line.middle - far * perp(line.along);
      const Nearest here = nearest(place);
      if (here.beyond || -here.distance < 0.5 * far) break;
      if (-here.distance <= depth) continue;
      depth = -here.distance;
      deepest = place;
    }
  return deepest;
}

// After Eberly ("Distance from a point to an ellipse", 2013): with y the point in the first quadrant of the axes and a
// the longer one, the nearest place is (a² y₀/(t + a²), b² y₁/(t + b²)) with the greatest root t of
// (a y₀/(t + a²))² + (b y₁/(t + b²))² = 1, found by halving; where y₁ = 0 and there is none, at x = a² y₀/(a² − b²).
PlainOutline::Nearest PlainOutline::nearest_of_ellipse(const deck::EllipseOutline& ellipse, const Vec2& point) const {
  const Vec2 first(std::cos(ellipse.angle), std::sin(ellipse.angle)), second = perp(first);
  const Vec2 arm = point - Vec2(ellipse.centre.x, ellipse.centre.z);
  const bool swap = ellipse.axes.x < ellipse.axes.z;
  Vec2 axes(ellipse.axes.x, ellipse.axes.z), y(std::abs(arm.dot(first)), std::abs(arm.dot(second)));
  if (swap) std::swap(axes[0], axes[1]), std::swap(y[0], y[1]);
  const double a = axes[0], b = axes[1];
  Vec2 x;
  if (y[1] > 0.0) {
    double low = b * y[1] - b * b, high = std::hypot(a * y[0], b * y[1]) - b * b;
    for (int i = 0; i < 200 && low < high; ++i) {
      const double t = 0.5 * (low + high);
      if (t == low || t == high) break;
      const double on = std::hypot(a * y[0] / (t + a * a), b * y[1] / (t + b * b));
      (on > 1.0 ? low : high) = t;
    }
    x = {a * a * y[0] / (high + a * a), b * b * y[1] / (high + b * b)};
  } else if (y[0] * a < a * a - b * b) {
    const double part = a * y[0] / (a * a - b * b);
    x = {a * part, b * std::sqrt(1.0 - part * part)};
  } else {
    x = {a, 0.0};
  }
  const bool is_outside = std::hypot(y[0] / a, y[1] / b) > 1.0;
  const double outside = ellipse.keep == Keep::outside ? 1.0 : -1.0;
  Nearest nearest{.distance = outside * (is_outside ? 1.0 : -1.0) * (y - x).norm()};
  Vec2 normal(x[0] / (a * a), x[1] / (b * b));
  nearest.curvature = -outside / (a * a * b * b * std::pow(normal.norm(), 3));
  if (swap) std::swap(normal[0], normal[1]);
  const Vec2 in_plane =
      std::copysign(normal[0], arm.dot(first)) * first + std::copysign(normal[1], arm.dot(second)) * second;
  nearest.angle = angle_of(in_plane) - outside * 0.5 * pi;
  return nearest;
}

// The centre of a corner's arc is where the lines at the radius from both sides meet.
void PlainOutline::make_parts(const std::vector<Vec2>& corners, const std::vector<double>& radii, bool is_closed) {
  const std::size_t count = corners.size(), lines = is_closed ? count : count - 1;
  const auto direction = [&](std::size_t i) { return (corners[(i + 1) % count] - corners[i % count]).normalized(); };
  std::vector<Part> arcs(count);
  for (std::size_t i = 0; i < count; ++i) {
    Part& arc = arcs[i];
    arc = {.from = corners[i], .to = corners[i], .is_arc = true, .centre = corners[i]};
    if (!is_closed && (i == 0 || i + 1 == count)) continue;
    const Vec2 before = direction(i + count - 1), behind = direction(i);
    const double turn = before.x() * behind.y() - before.y() * behind.x();
    arc.radius = turn > 0.0 ? -radii[i] : radii[i];
    if (radii[i] == 0.0 || turn == 0.0) continue;
    width_ = std::min(width_, 2.0 * radii[i]);
    const Vec2 from_first = -arc.radius * perp(before), from_second = -arc.radius * perp(behind);
    arc.centre = meeting(corners[i] + from_first, before, corners[i] + from_second, behind);
    arc.from = arc.centre - from_first;
    arc.to = arc.centre - from_second;
  }
  for (std::size_t i = 0; i < lines; ++i) {
    parts_.push_back({.from = arcs[i].to, .to = arcs[(i + 1) % count].from});
    width_ = std::min(width_, (parts_.back().to - parts_.back().from).norm());
    if (is_closed || i + 1 < lines) parts_.push_back(arcs[(i + 1) % count]);
  }
}

// The nearest of the nearest places of all parts, their ends included.
PlainOutline::Nearest PlainOutline::nearest_of_parts(const Vec2& point) const {
  constexpr double round_off = 1e-12;  // by which a corner is as near as the ends of the lines that meet there
  double least = infinity;
  Nearest nearest;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.is_arc) {
      const Vec2 arm = point - part.centre, first = part.from - part.centre, last = part.to - part.centre;
      const double away = std::abs(arm.norm() - std::abs(part.radius));
      const bool is_sharp = part.radius == 0.0;
      const Part &before = parts_[i - 1], &behind = parts_[(i + 1) % parts_.size()];
      const bool between =
          is_sharp ? arm.dot(before.to - before.from) >= 0.0 && arm.dot(behind.to - behind.from) <= 0.0
                   : arm.dot(first + last) > 0.0 &&
                         (first.x() * arm.y() - first.y() * arm.x()) * (arm.x() * last.y() - arm.y() * last.x()) >= 0.0;
      if (!between || away > (1.0 + round_off) * least) continue;
      const double outside = part.radius >= 0.0 ? 1.0 : -1.0;
      least = away;
      nearest = {.distance = outside * (arm.norm() - std::abs(part.radius)),
                 .angle = angle_of(arm) - outside * 0.5 * pi,
                 .curvature = is_sharp ? -infinity : -outside / std::abs(part.radius)};
      continue;
    }
    const Vec2 side = part.to - part.from, along = side.normalized(), arm = point - part.from;
    const double ahead = along.dot(arm), there = std::clamp(ahead, 0.0, side.norm());
    const double away = (arm - there * along).norm();
    if (away >= (1.0 - round_off) * least) continue;
    least = away;
    const bool before_first = !is_closed_ && i == 0 && ahead < 0.0;
    const bool behind_last = !is_closed_ && i + 1 == parts_.size() && ahead > side.norm();
    nearest = {.distance = arm.dot(perp(along)), .angle = angle_of(along), .beyond = before_first || behind_last};
  }
  return nearest;
}

// A cubic between each two points by the distance between them, twice differentiable, as a linear system for the second
// derivatives: periodic, or with a third derivative that is continuous at the second point and the last but one.
void PlainOutline::make_curve(std::vector<Vec2> points, bool is_closed) {
  if (is_closed) points.push_back(points.front());
  const auto n = static_cast<Index>(points.size());
  at_ = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i) at_.push_back(at_.back() + (points[i] - points[i - 1]).norm());
  points_ = std::move(points);
  const auto width = [&](Index i) { return at_[static_cast<std::size_t>(i + 1)] - at_[static_cast<std::size_t>(i)]; };
  const auto slope = [&](Index i) {
    return Vec2((points_[static_cast<std::size_t>(i + 1)] - points_[static_cast<std::size_t>(i)]) / width(i));
  };
  Matrix A = Matrix::Zero(n, n), b = Matrix::Zero(n, 2);
  for (Index i = 1; i + 1 < n; ++i) {
    A.row(i).segment<3>(i - 1) << width(i - 1) / 6.0, (width(i - 1) + width(i)) / 3.0, width(i) / 6.0;
    b.row(i) = (slope(i) - slope(i - 1)).transpose();
  }
  if (is_closed) {
    A(0, 0) = 1.0;
    A(0, n - 1) = -1.0;
    A(n - 1, 0) += width(0) / 3.0;
    A(n - 1, 1) += width(0) / 6.0;
    A(n - 1, n - 2) += width(n - 2) / 6.0;
    A(n - 1, n - 1) += width(n - 2) / 3.0;
    b.row(n - 1) = (slope(0) - slope(n - 2)).transpose();
  } else if (n <= 3) {
    A(0, 0) = A(n - 1, n - 1) = 1.0;
    if (n == 3) A(0, 1) = A(2, 1) = -1.0;
  } else {
    A.row(0).head<3>() << -1.0 / width(0), 1.0 / width(0) + 1.0 / width(1), -1.0 / width(1);
    A.row(n - 1).tail<3>() << -1.0 / width(n - 3), 1.0 / width(n - 3) + 1.0 / width(n - 2), -1.0 / width(n - 2);
  }
  const Matrix second = Eigen::FullPivLU<Matrix>(A).solve(b);
  for (Index i = 0; i < n; ++i) bend_.emplace_back(second(i, 0), second(i, 1));
  for (Index i = 0; i + 1 < n; ++i) width_ = std::min(width_, width(i));
}

PlainOutline::OnCurve PlainOutline::on_curve(double a) const {
  const auto above = std::upper_bound(at_.begin() + 1, at_.end() - 1, a);
  const auto i = static_cast<std::size_t>(above - at_.begin()) - 1;
  const double h = at_[i + 1] - at_[i], l = (at_[i + 1] - a) / h, r = (a - at_[i]) / h;
  OnCurve on{.p = l * points_[i] + r * points_[i + 1] +
                  h * h / 6.0 * ((l * l * l - l) * bend_[i] + (r * r * r - r) * bend_[i + 1]),
             .first = (points_[i + 1] - points_[i]) / h +
                      h / 6.0 * ((1.0 - 3.0 * l * l) * bend_[i] + (3.0 * r * r - 1.0) * bend_[i + 1]),
             .second = l * bend_[i] + r * bend_[i + 1]};
  const std::size_t knot = r < 0.5 ? i : i + 1, last = at_.size() - 1;
  if (!is_closed_ && (knot == 0 || knot == last)) return on;
  const std::size_t before = knot == 0 ? last - 1 : knot - 1, behind = knot == last ? 0 : knot;  // intervals
  const double w = at_[before + 1] - at_[before], v = at_[behind + 1] - at_[behind];
  const Vec2 jump = (bend_[behind + 1] - bend_[behind]) / v - (bend_[before + 1] - bend_[before]) / w;
  const RoundedKnot more = rounded_knot(a - at_[knot], std::min(w, v));
  on.p += more.value * jump;
  on.first += more.slope * jump;
  on.second += more.second * jump;
  return on;
}

// The nearest of many places, and from there by halving what is on both sides of it.
PlainOutline::Nearest PlainOutline::nearest_of_curve(const Vec2& point) const {
  constexpr int places = 40;  // between two points
  double best = at_.front(), step = 0.0, least = infinity;
  for (std::size_t i = 0; i + 1 < at_.size(); ++i)
    for (int k = 0; k <= places; ++k) {
      const double a = at_[i] + (at_[i + 1] - at_[i]) * k / places, away = (point - on_curve(a).p).norm();
      if (away >= least) continue;
      least = away;
      best = a;
      step = (at_[i + 1] - at_[i]) / places;
    }
  const double end = at_.back();
  const auto wrapped = [&](double a) {
    if (!is_closed_) return std::clamp(a, 0.0, end);
    return a < 0.0 ? a + end : a > end ? a - end : a;
  };
  const auto leads_on = [&](double a) {  // whether the nearest place is farther along
    const OnCurve on = on_curve(wrapped(a));
    return (point - on.p).dot(on.first) > 0.0;
  };
  double low = best - 2.0 * step, high = best + 2.0 * step;
  if (!is_closed_) low = std::max(low, 0.0), high = std::min(high, end);
  if (!is_closed_ && !leads_on(low)) high = low;
  if (!is_closed_ && leads_on(high)) low = high;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (leads_on(middle) ? low : high) = middle;
  }
  const double a = wrapped(0.5 * (low + high));
  const OnCurve on = on_curve(a);
  const Vec2 along = on.first.normalized(), arm = point - on.p;
  const bool is_end = !is_closed_ && (a == 0.0 || a == end);
  return {.distance = arm.dot(perp(along)),
          .angle = angle_of(along),
          .curvature = (on.first.x() * on.second.y() - on.first.y() * on.second.x()) / std::pow(on.first.norm(), 3),
          .beyond = is_end && (a == 0.0 ? arm.dot(along) < 0.0 : arm.dot(along) > 0.0)};
}

}  // namespace arcwall::verify
