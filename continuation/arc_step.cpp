#include "continuation/arc_step.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "continuation/committed_point.hpp"
#include "continuation/corners/corner.hpp"
#include "continuation/corners/first_point.hpp"
#include "continuation/corners/friction_corner.hpp"
#include "continuation/events/eigenvalue_touch.hpp"
#include "continuation/events/step_events.hpp"
#include "continuation/events/target_values.hpp"
#include "continuation/events/value_before_change.hpp"
#include "continuation/known_places.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "continuation/stops.hpp"

namespace arcwall {

namespace {

// To the first point of an active set that was entered, or to where a guard vanishes before it: the pressure of a
// pressed part that falls from its beginning, say. What is violated by no more than where active sets are entered may
// stay so. Where a wall is between, the way there is taken in steps.
StepTried step_to_known_end(TraceTools& tools, const StepOrigin& origin) {
  const auto accepted = [&](StepEnd end) -> StepTried {
    if (is_clear(tools, origin.point().state, end.point.state)) return {.result = std::move(end)};
    return {.result = Rejected{.outcome = StepOutcome::penetration}};
  };
  StepEnd end{.point = *origin.from.known_end};
  const Vector& guards = end.point.guards;
  if (guards.size() == 0 || guards.minCoeff() >= -tools.options.guard_tolerance) return accepted(std::move(end));
  LandedStep landed = land_on_first_guard(tools, origin, end);
  if (landed.end && landed.end->landing) {
    decide_count(tools, landed.end->point);
    if (landed.end->landing->singular) landed.end->point.negative_eigenvalues.reset();
    return accepted(std::move(*landed.end));
  }
  bool holds = true;
  for (Index j = 0; j < guards.size(); ++j)
    holds = holds && guards[j] >= -tools.options.mesh_error_of(end.point.state.active_set, j);
  if (holds) return accepted(std::move(end));
  return {.result = Rejected{.outcome = StepOutcome::event_not_located, .failure = landed.failure}};
}

// A step of length s, or to where it ends if that is known already: the bound that has been passed, the first of the
// singular points that were located with the last one, the first point of an active set that was entered.
StepTried next_step(TraceTools& tools, const StepOrigin& origin, double s) {
  const Departure& from = origin.from;
  if (from.passed_bound) return {.result = StepEnd{.point = from.point, .landing = from.passed_bound}};
  if (!from.pending_singular.empty()) return {.result = StepEnd{.point = from.pending_singular.front().at}};
  if (from.known_end) return step_to_known_end(tools, origin);
  return try_step_clear_of_singular(tools, origin, s);
}

// The events inside a step; one of no length has none.
ArcEndSearch events_of(TraceTools& tools, const StepOrigin& origin, StepEnd step) {
  if (origin.metric.distance(step.point.state, origin.point().state) > 0.0)
    return locate_events(tools, origin, std::move(step));
  step.point.arc = origin.point().arc;
  return {.end = ArcEnd{.point = std::move(step.point), .landing = step.landing, .turn = step.turn}};
}

// Whether an end that was interpolated violates a contact by more than it is off: the step's end is on another branch.
bool strays_from_active_set(const ArcEnd& end) {
  const auto contacts = static_cast<Index>(end.point.state.active_set.size());
  return !end.singular.empty() && contacts > 0 && end.point.guards.head(contacts).minCoeff() < -singular_point_accuracy;
}

// The count at an arc's end.
StabilityCount count_at(TraceTools& tools, const StepOrigin& origin, const ArcEnd& end) {
  if (!end.singular.empty()) return {};  // an eigenvalue is zero there
  if (end.at_singular_change()) return {.unstable = origin.from.count_after.unstable};
  return tools.counter.count(end.point.state, end.point.negative_eigenvalues);
}

// A pitchfork met along its own branch, where λ turns and an eigenvalue touches zero, was reported on the other.
std::optional<BranchEnd> end_at_crossed_pitchfork(TraceTools& tools, const StepOrigin& origin, ArcEnd& end) {
  const bool crosses = !end.singular.empty() && end.singular.front().branching && end.singular.front().change % 2 == 0;
  if (!crosses) return std::nullopt;
  auto known = passed_known_place(tools, origin, end.point);
  if (!known) return std::nullopt;
  end.point.state = std::move(known->state);
  end.singular.clear();
  end.event.reset();
  return std::move(known->end);
}

// The bound that is met at a target value which was landed on: this one, or another of the same quantity and value.
std::optional<BranchEnd> bound_at(const std::vector<TargetValue>& targets, std::size_t which, const State& state) {
  std::optional<BranchEnd> met;
  const TargetValue& landed = targets[which];
  for (const TargetValue& target : targets)
    if (target.stops && target.value == landed.value && target.quantity->value(state) == landed.quantity->value(state))
      met = {.reason = EndReason::stop, .detail = target.label};
  return met;
}

// What is known just behind an arc's end if contacts do not change there.
Departure leave_smoothly(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                         const StabilityCount& behind) {
  const Departure& from = origin.from;
  Departure leave{.negative_eigenvalues = from.negative_eigenvalues, .count_after = behind};
  if (!end.singular.empty()) {
    const SingularPoint& first = end.singular.front();
    leave.pending_singular.assign(std::next(end.singular.begin()), end.singular.end());
    leave.negative_eigenvalues = *from.negative_eigenvalues + first.change;
    leave.zero_eigenvalues = first.branching ? first.branching->multiplicity : 1;
  } else {
    const bool has_count = end.point.negative_eigenvalues.has_value();
    if (has_count || end.at_singular_change()) leave.negative_eigenvalues = end.point.negative_eigenvalues;
    leave.zero_eigenvalues = has_count ? 0 : 1;
  }
  leave.signs = signs_behind(tools, origin, end);
  leave.passed_bound = end.passed_bound;
  // Where an event on the way there ends the arc, the end that was known is that of the next step.
  const bool on_the_way = from.known_end && end.event && !end.landing && !end.passed_bound;
  if (on_the_way && origin.metric.distance(end.point.state, from.known_end->state) > coincidence_tolerance)
    leave.known_end = from.known_end;
  return leave;
}

// The contact whose slip ends at an arc's end, where it is that which ends the arc.
std::optional<Index> ended_slip(const TraceTools& tools, const ArcEnd& end) {
  if (!end.event || end.event->what != EventPlace::What::detector) return std::nullopt;
  const EventDetector& detector = tools.detectors[end.event->which];
  if (detector.kind != EventKind::contact_sticks) return std::nullopt;
  if (detector.label.empty()) return slowest_slip(*tools.system.friction(), end.point);
  return std::stol(detector.label);
}

// Whether contacts with friction change at an arc's end: any of theirs, but not the unknowns at a validity bound.
bool changes_by_friction(const TraceTools& tools, const ArcEnd& end) {
  if (!tools.system.has_friction()) return false;
  const ActiveSet& active_set = end.point.state.active_set;
  return !end.landing || end.landing->guard < static_cast<Index>(active_set.contacts()) ||
         is_friction_bound(tools.system, active_set, end.landing->guard);
}

// Where unknowns have changed and friction has to at once: the same place with what contacts do there.
CornerPassed with_friction_settled(TraceTools& tools, Corner corner, CornerPassed passed) {
  corner.at = passed.ahead();
  corner.before = corner.at.count;
  corner.signs = passed.signs;
  corner.without_progress = passed.without_progress + 1;
  CornerPassed settled = turn_friction_corner(tools, std::move(corner), std::nullopt, std::nullopt);
  passed.events.insert(passed.events.end(), settled.events.begin(), settled.events.end());
  passed.end = std::move(settled.end);
  passed.without_progress = settled.without_progress;
  if (passed.end) return passed;
  passed.signs = std::move(settled.signs);
  if (!passed.entered) {
    passed.at = std::move(settled.at);
    return passed;
  }
  passed.entered->begin = std::move(settled.at);
  passed.entered->first.reset();
  return passed;
}

// The change of contacts at an arc's end.
CornerPassed pass_corner(TraceTools& tools, const TracerState& state, const ArcEnd& end,
                         const std::vector<int>& signs) {
  const bool stands = end.length <= tools.options.guard_tolerance;
  Corner corner{.at = end.point,
                .slack = end.landing ? end.landing->slack : 0.0,
                .signs = signs,
                .before = state.from.count_after,
                .lambda_scale = state.lambda_scale,
                .without_progress = stands ? state.corners_without_progress + 1 : 0};
  if (changes_by_friction(tools, end))
    return turn_friction_corner(tools, std::move(corner),
                                end.landing ? std::optional(end.landing->guard) : std::nullopt, ended_slip(tools, end));
  const bool at_bound = end.landing->guard >= static_cast<Index>(end.point.state.active_set.size());
  if (!at_bound) return turn_corner(tools, std::move(corner), end.landing->guard, state.visited);
  CornerPassed passed = pass_bound(tools, corner, end.landing->guard);
  if (passed.end || !must_change_behind(tools, passed.ahead())) return passed;
  return with_friction_settled(tools, std::move(corner), std::move(passed));
}

// What is known just behind a change of contacts.
void leave_corner(const CornerPassed& passed, Departure& leave) {
  if (passed.end) return;
  const PathPoint& next = passed.ahead();
  for (std::size_t i = 0; i < passed.signs.size(); ++i)
    if (passed.signs[i] != 0 || passed.entered) leave.signs[i] = passed.signs[i];
  leave.negative_eigenvalues = next.negative_eigenvalues;
  leave.count_after = next.count;
}

// The next step's start: the point itself, and those of before as far as they serve.
void begin_next(const StepOrigin& origin, const PathPoint& next, bool smooth, Departure& leave) {
  leave.point = next;
  if (next.nearest.values.size() == 0) leave.last_pairs = origin.from.nearest();
  if (!smooth) return;
  leave.eigenvalues_before = eigenvalues_of_modes(next, origin.point(), origin.metric);
  leave.before = origin.point();
  leave.before->nearest = {};
}

// The target values between a change of contact and where the active set that was entered begins, the first of which is
// given, on the active set that ends.
std::vector<ValuePoint> values_before(TraceTools& tools, const Metric& metric, const PathPoint& change,
                                      const PathPoint& begin, std::optional<ValueBetween> value) {
  std::vector<ValuePoint> values;
  while (value) {
    const PathPoint& last = values.empty() ? change : values.back().at;
    auto at = point_beyond_bound(tools, metric, last, *value);
    if (!at) {  // told where the path is known last
      if (!values.empty()) values.push_back({.which = value->which, .at = values.back().at});
      break;
    }
    at->count = begin.count;
    values.push_back({.which = value->which, .at = std::move(*at)});
    value = first_value_between(tools.options.target_values, values.back().at, begin.state);
  }
  return values;
}

// Lands on a target value that lies between an arc's end and the active set ahead: behind the change where that is an
// event here, else before it, on the active set that ends; on the one ahead; or where the arc ends. No value is jumped
// over. Where the arc does not reach the active set ahead `passed` becomes empty.
void land_before_active_set_ahead(TraceTools& tools, const StepOrigin& origin, const ValueBetween& value, ArcEnd& end,
                                  std::optional<CornerPassed>& passed) {
  if (passed->entered) {
    EnteredActiveSet& entered = *passed->entered;
    entered.values = values_before(tools, origin.metric, end.point, entered.begin, value);
    if (!entered.values.empty()) return;
  } else if (auto beyond = land_beyond_bound(tools, origin, end, value)) {
    end = std::move(*beyond);
    end.point.count = count_at(tools, origin, end);
    passed.reset();
    return;
  }
  end.event = EventPlace{.what = EventPlace::What::target_value, .which = value.which, .t = 1.0};
  if (passed->entered || !land_active_set_ahead(tools, origin.metric.lambda_scale(), value, passed->at)) return;
  for (Event& event : passed->events)
    event.lambda_uncertainty =
        std::max(event.lambda_uncertainty, std::abs(passed->at.state.lambda - event.state.lambda));
}

// A change of contacts at an arc's end is left; empty where there is none.
std::optional<CornerPassed> leave_active_set(TraceTools& tools, const TracerState& state, const StepOrigin& origin,
                                             ArcEnd& end) {
  std::optional<CornerPassed> passed;
  end.point.count = count_at(tools, origin, end);
  if (!end.landing && !ended_slip(tools, end)) return passed;
  passed = pass_corner(tools, state, end, signs_behind(tools, origin, end));
  if (passed->end) return passed;
  if (changes_by_friction(tools, end)) return passed;  // the place stays
  if (const auto value = first_value_between(tools.options.target_values, end.point, passed->ahead().state))
    land_before_active_set_ahead(tools, origin, *value, end, passed);
  return passed;
}

// The end of an arc as the next step's start. Points that reach their bounds of friction together slip from there on,
// and λ or a monitor may turn.
void commit_end(TraceTools& tools, double lambda_scale, double length, PathPoint& end, Accepted& accepted) {
  PathTangent arrives{.state = end.state, .tangent = end.tangent};
  Departure& leave = accepted.leave;
  const auto changed = commit(tools, tools.metric_on(end.state.active_set, lambda_scale), arrives.tangent, length, end);
  if (!changed && !accepted.end) accepted.end = end_without_tangent();
  if (!changed.value_or(false)) return;
  const std::vector<int> before = std::exchange(leave.signs, signs_at(tools.detectors, end));
  add_turns(tools, before, leave.signs,
            {.state = end.state,
             .arc = end.arc,
             .residual = end.residual,
             .unstable_before = leave.count_after.unstable,
             .unstable_after = end.count.unstable},
            accepted.arc.events);
  leave.negative_eigenvalues = end.negative_eigenvalues;
  leave.count_after = end.count;
  if (!accepted.arc.arrives) accepted.arc.arrives = std::move(arrives);
}

Accepted accept(TraceTools& tools, const TracerState& state, const StepOrigin& origin, ArcEnd end, double s) {
  Accepted accepted{.corners_without_progress = state.corners_without_progress};
  std::optional<CornerPassed> passed = leave_active_set(tools, state, origin, end);
  accepted.end = end_at_crossed_pitchfork(tools, origin, end);
  const StabilityCount behind = count_behind(tools, origin, end);
  accepted.arc.events = events_at(tools, origin, end, behind);
  accepted.leave = leave_smoothly(tools, origin, end, behind);
  if (end.event && end.event->what == EventPlace::What::target_value)
    if (auto bound = bound_at(tools.options.target_values, end.event->which, end.point.state))
      accepted.end = std::move(bound);
  if (!end.landing && !passed && !accepted.end)
    if (auto known = passed_known_place(tools, origin, end.point)) accepted.end = std::move(known->end);
  if (!state.from.known_end && !state.from.passed_bound)
    accepted.progress = StepProgress{
        .iterations = end.point.iterations, .turn = end.turn, .taken = end.landing || end.event ? end.length : s};
  const bool smooth = !end.landing && !passed && end.length > 0.0 && !state.from.known_end;
  const bool new_contacts = end.landing || state.from.known_end;
  if (passed) {
    accepted.leave.count_after = origin.from.count_after;
    leave_corner(*passed, accepted.leave);
    accepted.corners_without_progress = passed->without_progress;
    std::move(passed->events.begin(), passed->events.end(), std::back_inserter(accepted.arc.events));
    accepted.visit = std::move(passed->visit);
    accepted.strategies = std::move(passed->strategies);
    if (!accepted.end) accepted.end = std::move(passed->end);
    accepted.arc.arrives = {.state = std::move(end.point.state), .tangent = std::move(end.point.tangent)};
    end.point = std::move(passed->at);
    // Behind a change of contact that was not left nothing is counted.
    if (accepted.end && passed->events.empty() && !passed->entered) end.point.count = origin.from.count_after;
  }
  for (Event& event : value_crossings(tools, origin, end, end.point, behind))
    accepted.arc.events.push_back(std::move(event));
  commit_end(tools, state.lambda_scale, end.length, end.point, accepted);
  if (!accepted.end && new_contacts)
    accepted.end = stop_at_contacts(tools.options, origin.point().state.active_set, end.point.state.active_set);
  if (!accepted.end) accepted.end = stop_at_events(tools.options, accepted.arc.events);
  begin_next(origin, passed && passed->entered ? passed->entered->begin : end.point, smooth, accepted.leave);
  if (passed && passed->entered) accepted.leave.known_end = std::move(passed->entered->first);
  if (passed && passed->entered && !passed->entered->values.empty()) {
    accepted.leave.values_ahead = std::move(passed->entered->values);
    accepted.leave.begin = std::exchange(accepted.leave.point, end.point);
  }
  accepted.arc.to = std::move(end.point);
  return accepted;
}

// To the first of the target values between a change of contact and the active set that was entered behind it, and from
// the last one on to where that active set begins.
Accepted accept_value_ahead(const TraceTools& tools, const TracerState& state) {
  Accepted accepted{.leave = state.from, .corners_without_progress = state.corners_without_progress};
  Departure& leave = accepted.leave;
  ValuePoint value = std::move(leave.values_ahead.front());
  leave.values_ahead.erase(leave.values_ahead.begin());
  const TargetValue& target = tools.options.target_values[value.which];
  accepted.end = bound_at(tools.options.target_values, value.which, value.at.state);
  if (!target.event.empty())
    accepted.arc.events.push_back(
        value_crossing(target, value.at, state.from.count_after.unstable, state.from.count_after.unstable));
  const double arc = value.at.arc;
  leave.point = leave.values_ahead.empty() ? std::move(*leave.begin) : value.at;
  if (leave.values_ahead.empty()) leave.begin.reset();
  leave.point.arc = arc;
  accepted.arc.to = std::move(value.at);
  return accepted;
}

}  // namespace

ArcAttempt attempt_arc(TraceTools& tools, const TracerState& state, double s, Effort effort) {
  const StepOrigin origin{.from = state.from,
                          .start = state.start,
                          .metric = tools.metric_on(state.from.point.state.active_set, state.lambda_scale),
                          .leaves_branch_point = state.points == 1 && state.start.forward,
                          .effort = effort};
  if (!state.from.values_ahead.empty())
    return {.ledger = {.arc = state.from.point.arc, .radius = s}, .result = accept_value_ahead(tools, state)};
  StepTried step = next_step(tools, origin, s);
  ArcAttempt attempt{.ledger = std::move(step.attempt)};
  attempt.ledger.arc = state.from.point.arc;
  attempt.ledger.radius = s;
  const auto rejected = [&](Rejected why) {
    attempt.ledger.outcome = why.outcome;
    attempt.result = why;
    return std::move(attempt);
  };
  if (auto* const retry = std::get_if<Retry>(&step.result)) {
    attempt.result = std::move(*retry);
    return attempt;
  }
  if (const auto* const why = std::get_if<Rejected>(&step.result)) return rejected(*why);
  ArcEndSearch located = events_of(tools, origin, std::get<StepEnd>(std::move(step.result)));
  if (!located.end || strays_from_active_set(*located.end))
    return rejected({.outcome = StepOutcome::events_unclear, .failure = located.failure});
  Accepted accepted = accept(tools, state, origin, std::move(*located.end), s);
  std::copy(accepted.strategies.begin(), accepted.strategies.end(), std::back_inserter(attempt.ledger.strategies));
  attempt.result = std::move(accepted);
  return attempt;
}

}  // namespace arcwall
