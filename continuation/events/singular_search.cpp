#include "continuation/events/singular_search.hpp"

#include "continuation/events/branch_point_search.hpp"
#include "continuation/events/limit_point.hpp"

namespace arcwall {

SingularSearch find_singular(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const Segment segment(origin.metric, origin.point(), to);
  if (hides_two_zeros(tools.detectors, segment, -detector_noise)) return {.clear = false};
  if (tools.options.events != EventSearch::locate || !tools.system.has_stability()) return {};
  SingularSearch touching = find_touching_limit(tools, origin, segment);
  if (!touching.clear || !touching.points.empty()) return touching;
  if (!origin.from.negative_eigenvalues || !to.negative_eigenvalues) return {};
  const bool turns = origin.from.signs.front() * sign_of(tools.detectors.front().value(to)) < 0;
  return turns ? find_limit_point(tools, origin, to) : find_branch_points(tools, origin, to);
}

}  // namespace arcwall
