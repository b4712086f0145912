#include "continuation/events/singular_search.hpp"

#include "continuation/events/branch_point_search.hpp"
#include "continuation/events/limit_point.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// The singular points before an end that has a count.
SingularSearch find_counted(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const bool turns = origin.from.signs.front() * sign_of(tools.detectors.front().value(to)) < 0;
  return turns ? find_limit_point(tools, origin, to) : find_branch_points(tools, origin, to);
}

// A change of contact at which the stiffness is singular itself has no count. The path just before it has that of the
// step's origin, or the step went over to another branch, or over what is singular, too.
SingularSearch find_before_singular_end(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  constexpr double just_before = 0.98;  // of the step
  const auto near = counted_point(tools, origin, segment, just_before);
  if (!near || near->negative_eigenvalues == origin.from.negative_eigenvalues) return {};
  return find_counted(tools, origin, *near);
}

}  // namespace

SingularSearch find_singular(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const Segment segment(origin.metric, origin.point(), to);
  if (hides_two_zeros(tools.detectors, segment, -detector_noise)) return {.clear = false};
  if (tools.options.events != EventSearch::locate ||
      tools.system.counted_directions(origin.point().state.active_set) == CountedDirections::none)
    return {};
  SingularSearch touching = find_touching_limit(tools, origin, segment);
  if (!touching.clear || !touching.points.empty()) return touching;
  if (!origin.from.negative_eigenvalues) return {};
  return to.negative_eigenvalues ? find_counted(tools, origin, to) : find_before_singular_end(tools, origin, segment);
}

}  // namespace arcwall
