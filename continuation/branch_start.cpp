#include "continuation/branch_start.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "continuation/committed_point.hpp"
#include "continuation/corners/corner.hpp"
#include "continuation/corners/friction_corner.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

// At a branch point K is singular; `behind` is the count on the branch right behind it.
Arc first_arc(const PathPoint& at, const StabilityCount& behind, std::vector<Event> corner_events) {
  Arc arc{.to = at, .events = std::move(corner_events)};
  arc.events.insert(arc.events.begin(), Event{.kind = EventKind::start,
                                              .state = at.state,
                                              .residual = at.residual,
                                              .unstable_before = at.count.unstable,
                                              .unstable_after = behind.unstable});
  return arc;
}

// The start on the path at its own λ, or as it is if that cannot be corrected.
CorrectorResult correct_start(TraceTools& tools, const Metric& metric, const State& start, const Direction& forward) {
  constexpr double distance = 1e-6;  // of the start from the path [path metric]
  const ParameterValue parameter;
  CorrectorResult result =
      tools.corrector.correct(start, ValueConstraint(parameter, start.lambda), metric, forward, distance);
  if (!result.converged()) return tools.corrector.inspect(start, metric, forward);
  result.state.lambda = start.lambda;  // to the last digit
  return result;
}

// Its forward tangent, and the contacts that already touch or have just changed. Where constant loads have grown to
// just behind such a change, the start itself has passed a validity bound.
BranchBegun begin_at_state(TraceTools& tools, const TracerState& state) {
  const double first = state.start.sense * tools.options.step.first;
  const State& start = state.start.state;
  const Metric metric = tools.metric_on(start.active_set, state.lambda_scale);
  const Direction forward{.dx = Vector::Zero(start.x.size()), .dlambda = first > 0.0 ? 1.0 : -1.0};
  CorrectorResult result = correct_start(tools, metric, start, forward);
  BranchBegun begun;
  if (!result.converged()) {
    const bool finite = result.status != CorrectorStatus::not_finite;
    begun.end = {.reason = finite ? EndReason::singular : EndReason::not_finite, .detail = "at the start"};
    return begun;
  }
  PathPoint at = path_point(tools.system, metric, std::move(result), forward);
  if (tools.system.has_friction())
    if (std::string why = tools.system.friction()->why_not_modelled(at.state.active_set); !why.empty()) {
      begun.end = {.reason = EndReason::not_modelled, .detail = std::move(why)};
      return begun;
    }
  decide_count(tools, at);
  std::vector<Event> events;
  const ActiveSet& active_set = at.state.active_set;
  const bool touches = tools.system.guard_count(active_set) > 0 &&
                       !degenerate_contacts(at.guards, active_set, tools.options.guard_tolerance).empty();
  if (touches || may_change_at_start(tools, at)) {
    const Corner corner{.at = at, .lambda_scale = state.lambda_scale, .begins_branch = true};
    CornerPassed passed = tools.system.has_friction() ? turn_friction_corner(tools, corner, std::nullopt, std::nullopt)
                                                      : turn_corner(tools, corner, std::nullopt, {});
    begun.end = std::move(passed.end);
    if (begun.end) return begun;
    begun.visit = std::move(passed.visit);
    events = std::move(passed.events);
    at = std::move(passed.at);
  }
  const bool is_committed =
      commit(tools, tools.metric_on(at.state.active_set, state.lambda_scale), forward, 0.0, at).has_value();
  at.count = tools.counter.count(at.state, at.negative_eigenvalues);
  std::optional<EnteredActiveSet> entered;
  if (const auto bound = bound_passed_at(tools.system, at, tools.options.guard_tolerance)) {
    CornerPassed passed = pass_bound(tools,
                                     {.at = at,
                                      .slack = -at.guards[*bound],
                                      .signs = signs_at(tools.detectors, at),
                                      .lambda_scale = state.lambda_scale,
                                      .begins_branch = true},
                                     *bound);
    begun.end = std::move(passed.end);
    if (begun.end) return begun;
    std::move(passed.events.begin(), passed.events.end(), std::back_inserter(events));
    entered = std::move(passed.entered);
    if (!entered) at = std::move(passed.at);
  }
  begun.arc = first_arc(at, at.count, std::move(events));
  begun.from.point = entered ? std::move(entered->begin) : std::move(at);
  const PathPoint& from = begun.from.point;
  begun.step_length = std::abs(first / from.tangent.dlambda);
  begun.from.signs = signs_at(tools.detectors, from);
  begun.from.negative_eigenvalues = from.negative_eigenvalues;
  begun.from.count_after = from.count;
  if (entered) begun.from.known_end = std::move(entered->first);
  if (!is_committed && !begun.end) begun.end = end_without_tangent();
  return begun;
}

// A point just behind a branch point, where K is regular again, with its count; empty where there is none, as between
// walls that are too near.
std::optional<PathPoint> point_just_behind(TraceTools& tools, const Metric& metric, const BranchStart& start) {
  const double s = just_behind * start.distance;
  const Direction& forward = *start.forward;
  const PlaneConstraint plane(metric, start.state, start.mode, s * metric.inner(forward, start.mode));
  CorrectorResult result = tools.corrector.correct(moved(start.state, forward, s), plane, metric, forward, s);
  if (!result.converged() || metric.distance(result.state, start.state) > 2.0 * s) return std::nullopt;
  PathPoint at = path_point(tools.system, metric, std::move(result), forward);
  const bool is_outside = at.guards.size() == 0 || at.guards.minCoeff() >= -tools.options.guard_tolerance;
  if (!is_outside || tools.system.penetrated_place(at.state, -penetration_tolerance)) return std::nullopt;
  decide_count(tools, at);
  return at;
}

// At a branch point K is singular: signs are taken up behind the first step, the count a little way along it.
BranchBegun begin_at_branch_point(TraceTools& tools, const TracerState& state) {
  const BranchStart& start = state.start;
  const Direction& forward = *start.forward;
  const Metric metric = tools.metric_on(start.state.active_set, state.lambda_scale);
  CorrectorResult result = tools.corrector.inspect(start.state, metric, forward);
  result.state = start.state;
  result.tangent = forward;
  PathPoint at = path_point(tools.system, metric, std::move(result), forward);
  at.negative_eigenvalues = std::nullopt;
  at.count = {};
  BranchBegun begun{.step_length = start.distance};
  begun.from.signs = signs_at(tools.detectors, at);
  if (const auto behind = point_just_behind(tools, metric, start)) {
    begun.from.negative_eigenvalues = behind->negative_eigenvalues;
    begun.from.count_after = tools.counter.count(behind->state, behind->negative_eigenvalues);
    begun.from.zero_eigenvalues = 1;
  }
  begun.arc = first_arc(at, begun.from.count_after, {});
  begun.from.point = std::move(at);
  return begun;
}

// Behind a corner its first points are known, and it is followed from there.
BranchBegun begin_behind_corner(TraceTools& tools, const TracerState& state) {
  const BranchStart& start = state.start;
  const EnteredBranch& entered = *start.entered;
  const auto point_at = [&](const State& there, const Direction& forward) {
    const Metric metric = tools.metric_on(there.active_set, state.lambda_scale);
    CorrectorResult result = tools.corrector.inspect(there, metric, forward);
    result.state = there;
    return path_point(tools.system, metric, std::move(result), forward);
  };
  const auto counted = [&](const State& there) {
    PathPoint at = point_at(there, entered.tangent);
    decide_count(tools, at);
    at.count = tools.counter.count(at.state, at.negative_eigenvalues);
    return at;
  };
  PathPoint corner = point_at(start.state, {.dx = Vector::Zero(start.state.x.size()), .dlambda = 1.0});
  corner.negative_eigenvalues = std::nullopt;
  corner.count = {};
  PathPoint first = counted(entered.first);
  BranchBegun begun;
  begun.from.point = counted(entered.begin);
  begun.arc = first_arc(corner, begun.from.point.count, {});
  const PathPoint& from = begun.from.point;
  const Metric metric = tools.metric_on(first.state.active_set, state.lambda_scale);
  begun.step_length = std::max(metric.distance(first.state, from.state), entered.distance);
  begun.from.signs = signs_at(tools.detectors, from);
  begun.from.negative_eigenvalues = from.negative_eigenvalues;
  begun.from.count_after = from.count;
  begun.from.known_end = std::move(first);
  return begun;
}

}  // namespace

BranchBegun begin_branch(TraceTools& tools, const TracerState& state) {
  if (state.start.entered) return begin_behind_corner(tools, state);
  return state.start.forward ? begin_at_branch_point(tools, state) : begin_at_state(tools, state);
}

}  // namespace arcwall
