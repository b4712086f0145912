#include "continuation/known_places.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/turns.hpp"

namespace arcwall {

namespace {

// Whether the arc passes a place of its active set: it lies beside the chord, and on the path as exactly as such places
// are located.
bool passes(TraceTools& tools, const StepOrigin& origin, const PathPoint& to, const State& place) {
  const Metric& metric = origin.metric;
  const Segment segment(metric, origin.point(), to);
  const double L = segment.length();
  // A turning point at a pitchfork is located there, a little before or behind it.
  if (metric.distance(to.state, place) <= std::min(singular_point_accuracy, 0.25 * L)) return true;
  const Direction offset = difference(place, origin.point().state);
  const double t = metric.inner(offset, segment.chord()) / (L * L);
  if (!(t > 0.0 && t <= 1.0 + coincidence_tolerance)) return false;
  const double beside_chord = std::sqrt(std::max(0.0, metric.inner(offset, offset) - t * t * L * L));
  if (beside_chord > 0.25 * L) return false;
  const PlaneConstraint plane(metric, place, segment.chord(), 0.0);
  const auto at = correct_onto(tools, origin, plane, segment, std::min(t, 1.0)).point;
  return at && metric.distance(at->state, place) <= singular_point_accuracy;
}

// The known state as the arc passes it, by its own multiples of 2π; empty if it does not pass.
std::optional<State> passed(TraceTools& tools, const StepOrigin& origin, const PathPoint& to, const State& known) {
  if (known.active_set != to.state.active_set) return std::nullopt;
  // What lies beside the chord has its λ there, too.
  const double lambda_off = std::abs(known.lambda - to.state.lambda) / origin.metric.lambda_scale();
  if (lambda_off > 1.1 * (to.arc - origin.point().arc) + singular_point_accuracy) return std::nullopt;
  State place = turned_towards(tools.system, to.state, known);
  return passes(tools, origin, to, place) ? std::optional(std::move(place)) : std::nullopt;
}

}  // namespace

std::optional<KnownPlace> passed_known_place(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const bool far_from_start = to.arc > 3.0 * (to.arc - origin.point().arc) + coincidence_tolerance;
  if (!far_from_start) return std::nullopt;
  const BranchStart& start = origin.start;
  if (auto place = passed(tools, origin, to, start.state))
    return KnownPlace{.state = std::move(*place),
                      .end = {.reason = EndReason::closed_loop, .detail = "the branch came back to its start"}};
  for (const KnownPoint& known : start.known)
    if (auto place = passed(tools, origin, to, known.state))
      return KnownPlace{.state = std::move(*place),
                        .end = {.reason = EndReason::reached_branch,
                                .detail = "joins branch " + std::to_string(known.branch),
                                .partner = known.branch}};
  return std::nullopt;
}

}  // namespace arcwall
