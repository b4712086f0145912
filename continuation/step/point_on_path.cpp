#include "continuation/step/point_on_path.hpp"

#include <algorithm>
#include <utility>

#include "continuation/path_tolerances.hpp"

namespace arcwall {

PathPoint path_point(const System& system, const Metric& metric, CorrectorResult result, const Direction& forward) {
  PathPoint point;
  point.tangent =
      metric.inner(result.tangent, forward) >= 0.0 ? std::move(result.tangent) : reversed(std::move(result.tangent));
  point.state = std::move(result.state);
  point.negative_eigenvalues = point.count.unstable = result.negative;
  point.iterations = result.iterations;
  point.residual = result.residual;
  point.unsettled = result.unsettled;
  point.nearest = std::move(result.nearest);
  GuardsAlong guards = system.guards_along(point.state, point.tangent);
  point.guards = std::move(guards.values);
  point.guard_rates = std::move(guards.rates);
  return point;
}

CorrectedPoint correct_onto(TraceTools& tools, const StepOrigin& origin, const PathConstraint& constraint,
                            const Segment& segment, double t) {
  return correct_onto(tools, origin, constraint, segment, segment.at(t), segment.length() * std::min(t, 1.0 - t),
                      Wanted::pairs);
}

namespace {

// A correction as a point inside a step.
CorrectedPoint inside_step(TraceTools& tools, const StepOrigin& origin, const Segment& segment,
                           CorrectorResult result) {
  const PathPoint& from = origin.point();
  CorrectedPoint corrected{.point = std::nullopt, .status = result.status};
  if (!result.converged()) return corrected;
  // The place must lie inside the step, up to the curvature of the arc: beside it another branch may have the value.
  constexpr double inside = 1.2;
  const double along = origin.metric.inner(difference(result.state, from.state), segment.chord()) / segment.length();
  const double before = std::max(1e-6 * segment.length(), 2.0 * kink_accuracy);  // a step may begin just past a kink
  if (along < -before || along > inside * segment.length()) return corrected;
  const auto distance_to = [&](const PathPoint& end) { return origin.metric.distance(result.state, end.state); };
  if (distance_to(segment.from()) > inside * segment.length() || distance_to(segment.to()) > inside * segment.length())
    return corrected;
  corrected.point = path_point(tools.system, origin.metric, std::move(result), from.tangent);
  return corrected;
}

// Of a guess from points that are known.
double sure_distance(const Segment& segment, double distance) { return std::max(distance, 1e-3 * segment.length()); }

}  // namespace

CorrectedPoint correct_onto(TraceTools& tools, const StepOrigin& origin, const PathConstraint& constraint,
                            const Segment& segment, State guess, double distance, Wanted wanted) {
  return inside_step(tools, origin, segment,
                     tools.corrector.correct(std::move(guess), constraint, origin.metric, origin.point().tangent,
                                             sure_distance(segment, distance), wanted));
}

void find_pairs(TraceTools& tools, const Metric& metric, PathPoint& at) {
  CorrectorResult seen = tools.corrector.find_pairs(at.state, metric);
  at.nearest = std::move(seen.nearest);
  at.negative_eigenvalues = at.count.unstable = seen.negative;
}

void decide_count(TraceTools& tools, PathPoint& point) {
  if (point.negative_eigenvalues) return;
  if (tools.corrector.is_at(point.state))
    tools.counter.remember(point.state, tools.corrector.count_here(point.state, point.nearest));
  point.negative_eigenvalues = point.count.unstable = tools.counter.negative_on(point.state);
}

std::optional<PathPoint> counted_point(TraceTools& tools, const StepOrigin& origin, const Segment& segment, double t) {
  const ChordPlaneConstraint plane(origin.metric, segment.from().state, segment.to().state, t);
  auto point = correct_onto(tools, origin, plane, segment, t).point;
  if (!point) return std::nullopt;
  decide_count(tools, *point);
  return point->negative_eigenvalues ? point : std::nullopt;
}

}  // namespace arcwall
