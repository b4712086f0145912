#include "continuation/events/event_detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/trace_options.hpp"

namespace arcwall {

EventDetector limit_point_detector(const Metric& metric) {
  const double scale = metric.lambda_scale();
  return {.kind = EventKind::limit_point,
          .label = "lambda",
          .value = [scale](const PathPoint& point) { return point.tangent.dlambda / scale; },
          .integral = [scale](const PathPoint& point) { return point.state.lambda / scale; }};
}

// The metric measures how fast a place moves. It has no measure for forces: they are measured by their own value, and
// by their rate where they begin at zero, as where contact has just closed. Beside that, what is a sum of contact
// forces is as uncertain as motion is. A force that strains tell is a sum of n parts which are as great as the
// stiffness, though no equilibrium moves that way: their round-off is all that hides its rate.
EventDetector turning_detector(const Equations& system, const Metric& metric, const Watch& watch) {
  const double lambda_scale = metric.lambda_scale();
  const auto rate = [&system, lambda_scale, quantity = watch.quantity, kind = watch.kind](const PathPoint& at) {
    const Row row = quantity->gradient(at.state);
    const Metric here(system.weights(at.state.active_set), lambda_scale);
    const double along = apply(row, at.tangent), motion = here.dual_norm(row);
    if (kind == Watch::Kind::motion) return motion > 0.0 ? along / motion : 0.0;
    const double own = std::max(std::abs(quantity->value(at.state)), std::abs(along));
    const double roundoff = double(row.dx.size()) * std::numeric_limits<double>::epsilon() / detector_noise;
    const double norm = std::hypot(own, kind == Watch::Kind::contact_force ? motion : roundoff * motion);
    return norm > 0.0 ? along / norm : 0.0;
  };
  return {.kind = EventKind::turning_point, .label = watch.label, .value = rate, .integral = nullptr};
}

}  // namespace arcwall
