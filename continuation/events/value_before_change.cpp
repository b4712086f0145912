#include "continuation/events/value_before_change.hpp"

#include <cmath>
#include <utility>

#include "continuation/events/target_values.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// The point on a target value near another one of the path, approached in a few parts. Empty where one of them is
// farther off the tangent than it is away.
std::optional<PathPoint> point_on_value(TraceTools& tools, const Metric& metric, const TargetValue& target,
                                        const PathPoint& near) {
  constexpr int parts = 4;
  const double missing = -excess(target, near.state);
  PathPoint at = near;
  for (int i = parts - 1; i >= 0; --i) {
    const double value = target.value - missing * i / parts;
    const double rate = target.quantity->rate(at.state, at.tangent);
    const double s = (value - target.quantity->value(at.state)) / rate;
    const State guess = moved(at.state, at.tangent, s);
    CorrectorResult result =
        tools.corrector.correct(guess, ValueConstraint(*target.quantity, value), metric, at.tangent, std::abs(s));
    if (!result.converged() || !(metric.distance(result.state, guess) <= std::abs(s))) return std::nullopt;
    at = path_point(tools.system, metric, std::move(result), at.tangent);
  }
  decide_count(tools, at);
  at.arc = near.arc;
  return at;
}

}  // namespace

std::optional<ValueBetween> first_value_between(const std::vector<TargetValue>& targets, const PathPoint& behind,
                                                const State& ahead) {
  std::optional<ValueBetween> first;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!lies_between(targets[i], behind.state, ahead)) continue;
    const double v0 = excess(targets[i], behind.state), v1 = excess(targets[i], ahead);
    const double rate = targets[i].quantity->rate(behind.state, behind.tangent);
    if (v0 * rate >= 0.0) continue;
    const ValueBetween found{.which = i, .part = v0 / (v0 - v1), .distance = -v0 / rate};
    if (!first || found.part < first->part) first = found;
  }
  return first;
}

std::optional<PathPoint> point_beyond_bound(TraceTools& tools, const Metric& metric, const PathPoint& near,
                                            const ValueBetween& value) {
  constexpr double entered = 1e-6;  // of a wall between contacts: farther beyond the bound the active set is another
  auto at = point_on_value(tools, metric, tools.options.target_values[value.which], near);
  if (!at || tools.system.penetrated_place(at->state, -entered)) return std::nullopt;
  at->arc += value.distance;
  return at;
}

std::optional<ArcEnd> land_beyond_bound(TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                                        const ValueBetween& value) {
  auto at = point_beyond_bound(tools, origin.metric, end.point, value);
  if (!at) return std::nullopt;
  return ArcEnd{.point = std::move(*at),
                .length = end.length + value.distance,
                .event = EventPlace{.what = EventPlace::What::target_value, .which = value.which, .t = 1.0},
                .beyond = end.point,
                .passed_bound = end.landing,
                .turn = end.turn};
}

bool land_active_set_ahead(TraceTools& tools, double lambda_scale, const ValueBetween& value, PathPoint& ahead) {
  const Metric metric = tools.metric_on(ahead.state.active_set, lambda_scale);
  auto at = point_on_value(tools, metric, tools.options.target_values[value.which], ahead);
  if (!at) return false;
  at->count = tools.counter.count(at->state, at->negative_eigenvalues);
  ahead = std::move(*at);
  return true;
}

}  // namespace arcwall
