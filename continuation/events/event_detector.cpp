#include "continuation/events/event_detector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcwall {

EventDetector limit_point_detector(const Metric& metric) {
  const double scale = metric.lambda_scale();
  return {.kind = EventKind::limit_point,
          .label = "lambda",
          .value = [scale](const PathPoint& point) { return point.tangent.dlambda / scale; },
          .integral = [scale](const PathPoint& point) { return point.state.lambda / scale; }};
}

EventDetector turning_detector(const Equations& system, const Metric& metric,
                               std::shared_ptr<const Observable> quantity, std::string label) {
  const double lambda_scale = metric.lambda_scale();
  // The metric has no measure for forces: what depends on these is measured by itself, and by its rate where it begins
  // at zero, as where contact has just closed.
  const auto rate = [&system, lambda_scale, quantity](const PathPoint& point) {
    const Row row = quantity->gradient(point.state);
    const Metric here(system.weights(point.state.active_set), lambda_scale);
    const bool of_forces = ((here.weights().array() == 0.0) && (row.dx.array() != 0.0)).any();
    const double along = apply(row, point.tangent);
    const double own = of_forces ? std::max(std::abs(quantity->value(point.state)), std::abs(along)) : 0.0;
    const double norm = std::hypot(here.dual_norm(row), own);
    return norm > 0.0 ? along / norm : 0.0;
  };
  return {.kind = EventKind::turning_point, .label = std::move(label), .value = rate, .integral = nullptr};
}

}  // namespace arcwall
