#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "contact/outline.hpp"
#include "core/cubic_spline.hpp"
#include "core/gauss_points.hpp"

namespace arcwall {

namespace {

constexpr double most_turn = pi / 18.0;  // of the tangent between two knots [rad]

// A place of a curve p(a) with its derivatives by the parameter.
struct OnCurve {
  Vec2 p, first, second, third, fourth;
};

double curvature_of(const OnCurve& at) { return cross(at.first, at.second) / std::pow(at.first.norm(), 3); }

// d κ / d length
double curvature_slope_of(const OnCurve& at) {
  const double v = at.first.norm(), bend = cross(at.first, at.second);
  return (cross(at.first, at.third) - 3.0 * bend * at.first.dot(at.second) / (v * v)) / std::pow(v, 4);
}

// d² κ / d length²
double curvature_second_of(const OnCurve& at) {
  const double v2 = at.first.squaredNorm(), bend = cross(at.first, at.second);
  const double bend_rate = cross(at.first, at.third), lengthens = at.first.dot(at.second);
  const double bend_second = cross(at.second, at.third) + cross(at.first, at.fourth);
  const double lengthens_rate = at.second.squaredNorm() + at.first.dot(at.third);
  return (bend_second - (7.0 * bend_rate * lengthens + 3.0 * bend * lengthens_rate) / v2 +
          18.0 * bend * lengthens * lengthens / (v2 * v2)) /
         std::pow(v2, 2.5);
}

// A smooth curve p(a), of which the derived class gives the knots in ascending order: between two of them it turns by a
// small angle. The foot of a position r is where h = (r − p)·p′ vanishes and goes from + to −. It is looked for between
// each two knots with such a change that may be nearer than the nearest knot, in brackets: no position fails.
class ParametricOutline : public Outline {
 public:
  OutlineFoot foot(const Vec2& position) const final {
    std::size_t nearest = 0;
    std::vector<double> far(knots_.size());
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      far[i] = (position - at_knots_[i].p).norm();
      if (far[i] < far[nearest]) nearest = i;
    }
    double best = knots_[nearest], least = far[nearest];
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
      if (std::max(far[i], far[i + 1]) - lengths_[i] > least) continue;
      if (!comes_nearer(position, at_knots_[i], true) || !comes_nearer(position, at_knots_[i + 1], false)) continue;
      const double a = foot_between(position, knots_[i], knots_[i + 1]), there = (position - at(a).p).norm();
      if (there < least) std::tie(best, least) = std::pair(a, there);
    }
    return foot_at(position, best == knots_[nearest] ? downhill_from(position, nearest) : best);
  }

  std::vector<double> knots() const final {
    return is_closed_ ? std::vector(knots_.begin(), knots_.end() - 1) : knots_;
  }
  double period() const final { return is_closed_ ? knots_.back() - knots_.front() : 0.0; }
  double length_to(double along) const final {
    const auto next = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, along);
    const auto i = static_cast<std::size_t>(next - knots_.begin()) - 1;
    const double beyond = along - std::clamp(along, knots_.front(), knots_.back());
    return length_before_[i] + length_between(knots_[i], along - beyond) + beyond * at_knots_[i + 1].first.norm();
  }
  double sharpest_hollow() const final { return sharpest_; }
  std::optional<Vec2> core() const final { return core_; }

  std::vector<Vec2> points(double) const final {
    constexpr int parts = 4;
    std::vector<Vec2> line;
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
      for (int k = 0; k < parts; ++k) line.push_back(at(knots_[i] + (knots_[i + 1] - knots_[i]) * k / parts).p);
    line.push_back(at_knots_.back().p);
    return line;
  }

 protected:
  virtual OnCurve at(double a) const = 0;

  // The last knot of a closed one is the first.
  void look_at(std::vector<double> knots, bool is_closed) {
    constexpr int looks = 8;
    knots_ = std::move(knots);
    is_closed_ = is_closed;
    for (const double a : knots_) at_knots_.push_back(at(a));
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
      double length = 0.0;
      for (int k = 0; k < looks; ++k) {
        const double step = (knots_[i + 1] - knots_[i]) / looks;
        const OnCurve here = at(knots_[i] + k * step);
        length += (at(knots_[i] + (k + 1) * step).p - here.p).norm();
        sharpest_ = std::max(sharpest_, curvature_of(here));
      }
      constexpr double above_the_polygon = 1.01;
      lengths_.push_back(above_the_polygon * length);
    }
    length_before_.push_back(0.0);
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
      length_before_.push_back(length_before_.back() + length_between(knots_[i], knots_[i + 1]));
    if (!is_closed_ || runs_clockwise()) core_ = deepest_place(*this, points(0.0));
  }

 private:
  // By Gauss's rule of eight points: between two knots the curve turns little.
  double length_between(double from, double to) const {
    double length = 0.0;
    for (const auto& [place, weight] : gauss_points)
      for (const double sign : {-1.0, 1.0})
        length += weight * at(0.5 * (from + to) + sign * place * 0.5 * (to - from)).first.norm();
    return 0.5 * (to - from) * length;
  }

  // Then the body is outside.
  bool runs_clockwise() const {
    std::vector<Vec2> polygon;
    for (std::size_t i = 0; i + 1 < at_knots_.size(); ++i) polygon.push_back(at_knots_[i].p);
    return doubled_area(polygon) < 0.0;
  }

  // Whether the curve comes nearer to the position behind a place, or came nearer before it.
  static bool comes_nearer(const Vec2& position, const OnCurve& at, bool behind) {
    const double h = (position - at.p).dot(at.first), sign = behind ? 1.0 : -1.0;
    return h != 0.0 ? sign * h > 0.0 : (position - at.p).dot(at.second) >= at.first.squaredNorm();
  }

  // By Newton's method, within a bracket that is halved where it does not keep to it.
  double foot_between(const Vec2& position, double from, double to) const {
    const double smallest = 4e-16 * std::max({std::abs(from), std::abs(to), to - from});
    double a = 0.5 * (from + to);
    for (int i = 0; i < 100 && to - from > smallest; ++i) {
      const OnCurve on = at(a);
      const Vec2 arm = position - on.p;
      const double h = arm.dot(on.first), slope = arm.dot(on.second) - on.first.squaredNorm();
      if (h == 0.0) return a;
      (h > 0.0 ? from : to) = a;
      double next = slope < 0.0 ? a - h / slope : from;
      if (!(next > from && next < to)) next = 0.5 * (from + to);
      if (std::abs(next - a) <= smallest) return next;
      a = next;
    }
    return a;
  }

  // The least distance beside the nearest knot, where the curve comes nearer behind or before it and goes away again
  // without a change from knot to knot: beyond the centre of its curvature, nearly.
  double downhill_from(const Vec2& position, std::size_t knot) const {
    constexpr int looks = 32;
    const OnCurve& on = at_knots_[knot];
    const double h = (position - on.p).dot(on.first);
    const bool behind = h > 0.0, is_end = behind ? knot + 1 == knots_.size() : knot == 0;
    if (h == 0.0 || (is_end && !is_closed_)) return knots_[knot];
    const std::size_t from = !is_end ? knot : behind ? 0 : knots_.size() - 1;
    const double step = (knots_[behind ? from + 1 : from - 1] - knots_[from]) / looks;
    for (int i = 1; i <= looks; ++i) {
      const double a = knots_[from] + i * step;
      const OnCurve there = at(a);
      if (((position - there.p).dot(there.first) > 0.0) == behind) continue;
      return foot_between(position, std::min(a - step, a), std::max(a - step, a));
    }
    return knots_[knot];
  }

  OutlineFoot foot_at(const Vec2& position, double a) const {
    const OnCurve on = at(a);
    const Vec2 t = on.first.normalized(), arm = position - on.p;
    const bool is_end = !is_closed_ && (a == knots_.front() || a == knots_.back());
    const double before = t.dot(arm), bend = curvature_of(on), d = perp(t).dot(arm);
    const double widen = 1.0 / (1.0 - bend * d);
    return {.distance = d,
            .tangent = t,
            .curvature = bend * widen,
            .curvature_slope = curvature_slope_of(on) * std::pow(widen, 3),
            .curvature_second = curvature_second_of(on) * std::pow(widen, 4) +
                                3.0 * std::pow(curvature_slope_of(on), 2) * d * std::pow(widen, 5),
            .along = is_end ? a + before / on.first.norm() : a,
            .beyond = is_end && (a == knots_.back() ? before > 0.0 : before < 0.0),
            .from_end = arm.norm()};
  }

  std::vector<double> knots_{}, lengths_{}, length_before_{};
  std::vector<OnCurve> at_knots_{};
  bool is_closed_ = false;
  double sharpest_ = 0.0;
  std::optional<Vec2> core_{};
};

// c + R(angle) (A cos a, ∓B sin a): outside it runs clockwise.
class EllipseOutline final : public ParametricOutline {
 public:
  EllipseOutline(const Vec2& centre, const Vec2& half_axes, double angle, Keep keep)
      : centre_(centre),
        first_(half_axes.x() * Vec2(std::cos(angle), std::sin(angle))),
        second_((keep == Keep::inside ? 1.0 : -1.0) * half_axes.y() * Vec2(-std::sin(angle), std::cos(angle))) {
    // Where the tangent has turned by equal angles.
    const int count = static_cast<int>(std::lround(2.0 * pi / most_turn));
    std::vector<double> knots;
    for (int i = 0; i < count; ++i) {
      const double turned = -pi + 2.0 * pi * i / count;
      const double a = std::atan2(half_axes.y() * std::sin(turned), half_axes.x() * std::cos(turned));
      knots.push_back(i == 0 ? -pi : a);
    }
    knots.push_back(pi);
    look_at(std::move(knots), true);
  }

 protected:
  OnCurve at(double a) const override {
    const double c = std::cos(a), s = std::sin(a);
    const Vec2 arm = c * first_ + s * second_, along = c * second_ - s * first_;
    return {.p = centre_ + arm, .first = along, .second = -arm, .third = -along, .fourth = arm};
  }

  bool is_smooth() const override { return true; }

 private:
  Vec2 centre_, first_, second_;
};

std::vector<double> chord_lengths(const std::vector<Vec2>& points) {
  std::vector<double> sum{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) sum.push_back(sum.back() + (points[i] - points[i - 1]).norm());
  return sum;
}

std::vector<double> coordinates(const std::vector<Vec2>& points, int which) {
  std::vector<double> values;
  for (const Vec2& point : points) values.push_back(point[which]);
  return values;
}

class CurveOutline final : public ParametricOutline {
 public:
  // Of the parameters of the points those from `first` to `last` are the curve.
  CurveOutline(const std::vector<Vec2>& points, std::size_t first, std::size_t last, bool is_closed)
      : x_(chord_lengths(points), coordinates(points, 0), knot_rounding),
        z_(x_.knots(), coordinates(points, 1), knot_rounding) {
    std::vector<double> knots;
    for (std::size_t i = first; i < last; ++i) {
      const double from = x_.knots()[i], to = x_.knots()[i + 1];
      const int parts = parts_between(from, to);
      for (int k = 0; k < parts; ++k) knots.push_back(from + (to - from) * k / parts);
    }
    knots.push_back(x_.knots()[last]);
    look_at(std::move(knots), is_closed);
    for (std::size_t i = is_closed ? first : first + 1; i < last; ++i) {
      const OnCurve here = at(x_.knots()[i]);
      const Vec2 of_third(x_.third_derivative_jump(i), z_.third_derivative_jump(i));
      const double v = here.first.norm();
      jumps_.push_back({.place = here.p,
                        .tangent = here.first / v,
                        .jump = cross(here.first, of_third) / std::pow(v, 4),
                        .half_width = v * x_.half_width(i)});
    }
  }

  std::vector<CurvatureRateJump> curvature_rate_jumps() const override { return jumps_; }

 protected:
  OnCurve at(double a) const override {
    const auto x = x_.at(a), z = z_.at(a);
    return {
        .p = {x[0], z[0]}, .first = {x[1], z[1]}, .second = {x[2], z[2]}, .third = {x[3], z[3]}, .fourth = {0.0, 0.0}};
  }

 private:
  int parts_between(double from, double to) const {
    constexpr int looks = 32;
    double turn = 0.0;
    Vec2 before = at(from).first;
    for (int k = 1; k <= looks; ++k) {
      const Vec2 here = at(from + (to - from) * k / looks).first;
      turn += std::abs(turn_between(before, here));
      before = here;
    }
    return std::clamp(static_cast<int>(std::ceil(turn / most_turn)), 4, looks);
  }

  CubicSpline x_, z_;
  std::vector<CurvatureRateJump> jumps_{};
};

}  // namespace

std::unique_ptr<Outline> ellipse_outline(const Vec2& centre, const Vec2& half_axes, double angle, Keep keep) {
  return std::make_unique<EllipseOutline>(centre, half_axes, angle, keep);
}

std::unique_ptr<Outline> curve_outline(std::vector<Vec2> points) {
  const std::size_t last = points.size() - 1;
  return std::make_unique<CurveOutline>(points, 0, last, false);
}

// What the ends of a spline are like decays by 2 − √3 from knot to knot: with so many more points on both sides the
// curve goes round smoothly to round-off.
std::unique_ptr<Outline> closed_curve_outline(std::vector<Vec2> points, Keep keep) {
  constexpr std::size_t more = 32;
  if ((doubled_area(points) > 0.0) == (keep == Keep::outside)) std::reverse(points.begin(), points.end());
  const std::size_t count = points.size();
  std::vector<Vec2> around;
  for (std::size_t i = 0; i <= count + 2 * more; ++i) around.push_back(points[(i + count * more - more) % count]);
  return std::make_unique<CurveOutline>(around, more, more + count, true);
}

}  // namespace arcwall
