#include "apps/verify/rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace arcwall::verify {

namespace {

// To the next point with the same unknowns, or from the one before.
std::optional<Direction> way_at(const std::vector<RecordPoint>& points, std::size_t number) {
  const RecordPoint& here = points[number];
  const auto is_like = [&](std::size_t other) {
    return points[other].branch == here.branch && points[other].state.active_set == here.state.active_set &&
           points[other].state.x.size() == here.state.x.size();
  };
  const auto between = [&](std::size_t from, std::size_t to) {
    return Direction{.dx = points[to].state.x - points[from].state.x,
                     .dlambda = points[to].state.lambda - points[from].state.lambda};
  };
  if (number + 1 < points.size() && is_like(number + 1)) return between(number, number + 1);
  if (number > 0 && is_like(number - 1)) return between(number - 1, number);
  return std::nullopt;
}

// The derivatives of a quantity ahead and behind, from three values each: where it has a kink they differ.
struct Slopes {
  double ahead = 0.0, behind = 0.0;
};

Slopes slopes(const Observable& quantity, const State& at, const Direction& way, double step) {
  const auto value = [&](double t) {
    State moved = at;
    moved.x += t * way.dx;
    moved.lambda += t * way.dlambda;
    return quantity.value(moved);
  };
  const double here = value(0.0);
  return {.ahead = (4.0 * value(step) - value(2.0 * step) - 3.0 * here) / (2.0 * step),
          .behind = (3.0 * here - 4.0 * value(-step) + value(-2.0 * step)) / (2.0 * step)};
}

}  // namespace

void check_rates(const std::vector<Watch>& watched, const std::vector<RecordPoint>& points, std::size_t number,
                 Findings& findings) {
  constexpr double step = 1e-4, truncation = 1e-6;  // of the way
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const auto way = way_at(points, number);
  if (!way) return;
  const State& at = points[number].state;
  for (const Watch& watch : watched) {
    const auto row = watch.quantity->gradient(at);
    const double rate = apply(row, *way);
    const auto [ahead, behind] = slopes(*watch.quantity, at, *way, step);
    const double parts = row.dx.cwiseAbs().dot(at.x.cwiseAbs() + way->dx.cwiseAbs()) +
                         std::abs(watch.quantity->value(at)) + std::abs(row.dlambda * at.lambda);
    const double most = std::max(std::abs(ahead), std::abs(behind));
    findings.compare("watched monitors change as their rates say", std::abs(rate - 0.5 * (ahead + behind)),
                     std::abs(ahead - behind) + truncation * most + 16.0 * epsilon * parts / step,
                     "monitor " + watch.label);
  }
}

}  // namespace arcwall::verify
