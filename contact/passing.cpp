#include "contact/passing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace arcwall {

namespace {

double distance_from_origin(const Vec2& a, const Vec2& b) {
  const Vec2 chord = b - a;
  const double length = chord.squaredNorm();
  return length > 0.0 ? (a + std::clamp(-a.dot(chord) / length, 0.0, 1.0) * chord).norm() : a.norm();
}

}  // namespace

// The way is halved until no surface is as near to both ends of a part as it is long, or it cannot go deeper than what
// touches may be.
bool point_passes_through(const Obstacle& obstacle, const PlaceInStep& point, double from_lambda, double to_lambda,
                          double touching) {
  struct Look {
    double part, gap, clearance;
  };
  const auto look = [&](double part) {
    const Vec2 place = point.from + part * (point.to - point.from);
    const double lambda = from_lambda + part * (to_lambda - from_lambda);
    return Look{part, obstacle.gap_slope(place, lambda).value, obstacle.clearance(place, lambda)};
  };
  const Look from = look(0.0), to = look(1.0);
  if (!(from.gap > touching)) return false;
  if (to.gap < -touching) return true;
  const double way =
      (obstacle.seen_at_rest(point.to, to_lambda) - obstacle.seen_at_rest(point.from, from_lambda)).norm();
  std::vector<std::pair<Look, Look>> unsure{{from, to}};
  while (!unsure.empty()) {
    const auto [first, last] = unsure.back();
    unsure.pop_back();
    if ((last.part - first.part) * way <= first.clearance + last.clearance + 2.0 * touching) continue;
    const Look middle = look(0.5 * (first.part + last.part));
    if (middle.gap < -touching) return true;
    unsure.emplace_back(middle, last);
    unsure.emplace_back(first, middle);
  }
  return false;
}

// The line before, the way of its last point, the line behind and the way of its first point are a closed polygon. On
// the core itself a line would be on either side of it.
bool line_passes_core(const Obstacle& obstacle, const PlaceInStep& first, const PlaceInStep& last, double from_lambda,
                      double to_lambda, double touching) {
  const auto core = obstacle.core();
  if (!core) return false;
  const auto before = [&](const Vec2& place) { return Vec2(obstacle.seen_at_rest(place, from_lambda) - *core); };
  const auto behind = [&](const Vec2& place) { return Vec2(obstacle.seen_at_rest(place, to_lambda) - *core); };
  const Vec2 a = before(first.from), b = before(last.from), c = behind(last.to), d = behind(first.to);
  if (distance_from_origin(c, d) <= touching) return true;
  return std::abs(turn_between(a, b) + turn_between(b, c) + turn_between(c, d) + turn_between(d, a)) > pi;
}

// What turns by less than a right angle stays within the circle about its chord.
double turn_about(const Vec2& centre, const std::function<Vec2(double)>& line, double touching) {
  struct Part {
    double from, to;
    Vec2 first, last;
  };
  double turn = 0.0;
  std::vector<Part> parts{{0.0, 1.0, line(0.0) - centre, line(1.0) - centre}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const double chord = (part.last - part.first).norm();
    if (chord <= touching || distance_from_origin(part.first, part.last) > 0.5 * chord) {
      turn += turn_between(part.first, part.last);
      continue;
    }
    const double between = 0.5 * (part.from + part.to);
    const Vec2 middle = line(between) - centre;
    parts.push_back({part.from, between, part.first, middle});
    parts.push_back({between, part.to, middle, part.last});
  }
  return turn;
}

}  // namespace arcwall
