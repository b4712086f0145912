#include "continuation/events/branch_point_search.hpp"

#include <cmath>
#include <utility>

#include "continuation/events/branch_point.hpp"
#include "continuation/events/eigenvalue_touch.hpp"
#include "continuation/events/singular_locator.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// A contact may forbid one side of an asymmetric branch point.
bool is_one_sided(TraceTools& tools, const StepOrigin& origin, const BranchPoint& point) {
  const auto open = [&](int sign) {
    return step_off(tools.system, tools.corrector, origin.metric, point, way_off(origin.metric, point, sign),
                    origin.start.distance, tools.options.guard_tolerance)
        .has_value();
  };
  return open(1) != open(-1);
}

SingularPoint singular_at(TraceTools& tools, const StepOrigin& origin, const SingularPlace& place,
                          double chord_dlambda) {
  auto branching = std::make_shared<BranchPoint>(branch_point_at(tools.system, tools.corrector, origin.metric, place));
  const double uncertain = place.half_width + roundoff_width(tools.corrector, origin.metric, place, *branching);
  branching->lambda_uncertainty = uncertain * std::abs(chord_dlambda);
  PathPoint at = point_at(tools, origin, place);
  branching->mesh_artefact = tools.ties_contact_to_nodes(at.state.active_set);
  if (tools.system.multiplier_count(at.state.active_set) > 0 && branching->type == BranchType::transcritical &&
      branching->mode.dx.size() > 0 && is_one_sided(tools, origin, *branching))
    branching->type = BranchType::one_sided;
  return {.place = {.what = EventPlace::What::branch_point, .which = 0, .t = place.t, .half_width = 0.0},
          .at = std::move(at),
          .change = place.change,
          .branching = std::move(branching),
          .unconfirmed = place.touches};
}

}  // namespace

SingularSearch find_branch_points(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const Segment segment(origin.metric, origin.point(), to);
  const Index before = *origin.from.negative_eigenvalues, after = *to.negative_eigenvalues;
  std::vector<SingularPlace> places;
  if (after != before) {
    places = find_count_changes(tools.corrector, segment, origin.metric, before, after);
    if (places.empty()) return {.clear = false};
  } else if (may_touch_zero(tools, origin, segment)) {
    auto touches = find_touches(tools.corrector, segment, origin.metric, Vanishing::eigenvalue,
                                origin.from.zero_eigenvalues > 0, 0.0);
    if (!touches) return {.clear = segment.length() <= shortest_telling_step};
    places = std::move(*touches);
  }
  SingularSearch found;
  for (const SingularPlace& place : places)
    found.points.push_back(singular_at(tools, origin, place, segment.chord().dlambda));
  return found;
}

PathPoint point_at(TraceTools& tools, const StepOrigin& origin, const SingularPlace& place) {
  CorrectorResult result = tools.corrector.inspect(place.point.state, origin.metric, place.point.tangent);
  result.state = place.point.state;
  result.tangent = place.point.tangent;
  result.iterations = place.point.iterations;
  return path_point(tools.system, origin.metric, std::move(result), origin.point().tangent);
}

}  // namespace arcwall
