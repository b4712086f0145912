#include "continuation/known_places.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// Whether the arc passes a place: it lies beside the chord, and on the path as exactly as such places are located.
bool passes(TraceTools& tools, const StepOrigin& origin, const PathPoint& to, const State& place) {
  if (place.piece != to.state.piece) return false;
  // What lies beside the chord has its λ there, too.
  const Metric& metric = origin.metric;
  const double lambda_off = std::abs(place.lambda - to.state.lambda) / metric.lambda_scale();
  if (lambda_off > 1.1 * (to.arc - origin.point().arc) + singular_point_accuracy) return false;
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

}  // namespace

std::optional<KnownPlace> passed_known_place(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const bool far_from_start = to.arc > 3.0 * (to.arc - origin.point().arc) + coincidence_tolerance;
  if (!far_from_start) return std::nullopt;
  const BranchStart& start = origin.start;
  if (passes(tools, origin, to, start.state))
    return KnownPlace{.state = start.state,
                      .end = {.reason = EndReason::closed_loop, .detail = "the branch came back to its start"}};
  for (const KnownPoint& known : start.known)
    if (passes(tools, origin, to, known.state))
      return KnownPlace{.state = known.state,
                        .end = {.reason = EndReason::joined,
                                .detail = "joins branch " + std::to_string(known.branch),
                                .partner = known.branch}};
  return std::nullopt;
}

}  // namespace arcwall
