#include "model/central_differences.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

namespace {

double step_of_lambda(const State& state) { return 1e-6 * std::max(1.0, std::abs(state.lambda)); }

}  // namespace

Row central_differences(const State& state, const Vector& steps, const std::function<double(const State&)>& value) {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  State moved = state;
  const auto slope = [&](double& of, double step) {
    const double here = of;
    of = here + step;
    const double above = value(moved);
    of = here - step;
    const double below = value(moved);
    of = here;
    return (above - below) / (2.0 * step);
  };
  for (Index i = 0; i < steps.size(); ++i)
    if (steps[i] > 0.0) row.dx[i] = slope(moved.x[i], steps[i]);
  row.dlambda = slope(moved.lambda, step_of_lambda(state));
  return row;
}

double central_difference_along(const State& state, const Direction& direction, const Vector& steps,
                                const std::function<double(const State&)>& value) {
  const auto slope = [&](const Direction& along, double h) {
    return (value(moved(state, along, h)) - value(moved(state, along, -h))) / (2.0 * h);
  };
  double most_steps = 0.0;
  for (Index i = 0; i < steps.size(); ++i)
    if (steps[i] > 0.0) most_steps = std::max(most_steps, std::abs(direction.dx[i]) / steps[i]);
  double sum = 0.0;
  if (most_steps > 0.0)
    sum += slope({.dx = (steps.array() > 0.0).select(direction.dx, 0.0), .dlambda = 0.0}, 1.0 / most_steps);
  if (direction.dlambda != 0.0)
    sum += direction.dlambda * slope({.dx = Vector::Zero(state.x.size()), .dlambda = 1.0}, step_of_lambda(state));
  return sum;
}

Row DifferencedObservable::gradient(const State& state) const {
  const Differences beside = differences_at(state);
  return central_differences(state, beside.steps, beside.value);
}

double DifferencedObservable::rate(const State& state, const Direction& direction) const {
  const Differences beside = differences_at(state);
  return central_difference_along(state, direction, beside.steps, beside.value);
}

}  // namespace arcwall
