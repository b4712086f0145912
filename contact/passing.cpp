#include "contact/passing.hpp"

#include <cmath>

namespace arcwall {

namespace {

double winding_about(const Vec2& place, const std::vector<Vec2>& round) {
  double turned = 0.0;
  for (std::size_t i = 0; i < round.size(); ++i) {
    const Vec2 a = round[i] - place, b = round[(i + 1) % round.size()] - place;
    turned += turn_between(a, b);
  }
  return turned / (2.0 * pi);
}

}  // namespace

// The obstacle at rest is asked at λ = 0, where all that moves is where it is at rest.
bool point_passes_through(const Obstacle& obstacle, const PlaceInStep& point, double from_lambda, double to_lambda,
                          double touching) {
  constexpr int looks = 64;
  const double before = obstacle.gap_slope(point.from, from_lambda).value;
  const double behind = obstacle.gap_slope(point.to, to_lambda).value;
  if (!(before > touching)) return false;
  if (behind < -touching) return true;
  const Vec2 a = obstacle.seen_at_rest(point.from, from_lambda), b = obstacle.seen_at_rest(point.to, to_lambda);
  // It goes no farther than it would have to.
  if (std::isfinite(before) && std::isfinite(behind) && before + behind > (b - a).norm()) return false;
  for (int i = 1; i < looks; ++i) {
    const double part = double(i) / looks, lambda = from_lambda + part * (to_lambda - from_lambda);
    if (obstacle.gap_slope(point.from + part * (point.to - point.from), lambda).value < -touching) return true;
  }
  return false;
}

// The winding number of the way forth along the line before and back along that behind: over a place that was not swept
// it is 0, and a half over one on which the line was.
bool line_passes_through(const Obstacle& obstacle, const std::vector<PlaceInStep>& line, double from_lambda,
                         double to_lambda) {
  const auto core = obstacle.core();
  if (!core || line.empty()) return false;
  std::vector<Vec2> round;
  for (const PlaceInStep& place : line) round.push_back(obstacle.seen_at_rest(place.from, from_lambda));
  for (auto place = line.rbegin(); place != line.rend(); ++place)
    round.push_back(obstacle.seen_at_rest(place->to, to_lambda));
  return std::abs(winding_about(*core, round)) > 0.25;
}

}  // namespace arcwall
