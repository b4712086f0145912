#include "model/central_differences.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

Row central_differences(const State& state, const Vector& steps, const std::function<double(const State&)>& value) {
  constexpr double step_of_lambda = 1e-6;
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
  row.dlambda = slope(moved.lambda, step_of_lambda * std::max(1.0, std::abs(state.lambda)));
  return row;
}

}  // namespace arcwall
