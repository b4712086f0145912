#include "continuation/step/predictor.hpp"

#include "continuation/segment.hpp"

namespace arcwall {

State predicted(const System& system, PathMethod method, const StepOrigin& origin, double s) {
  constexpr double reach = 2.5;  // of the last step, to which a cubic is extrapolated
  const PathPoint& here = origin.point();
  const std::optional<PathPoint>& before = origin.from.before;
  const bool controlled = method == PathMethod::load || method == PathMethod::displacement;
  constexpr double in_reach = 1.0;  // of guards
  const bool guarded =
      system.guard_count(here.state.active_set) > 0 && (here.guards.size() == 0 || here.guards.minCoeff() <= in_reach);
  if (before && !controlled && !guarded && before->state.active_set == here.state.active_set) {
    const Segment last(origin.metric, *before, here);
    if (s <= reach * last.length()) return last.at(1.0 + s / last.length());
  }
  return moved(here.state, here.tangent, s);
}

}  // namespace arcwall
