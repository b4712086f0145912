#include "continuation/corners/transitions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "continuation/corners/corner.hpp"
#include "continuation/corners/first_point.hpp"
#include "continuation/events/branch_point.hpp"
#include "continuation/stops.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

constexpr int most_bounds_at_one_place = 50;

// Of a transition that is an event. `more`: separate contacts ahead of it, less those before it. A zone that begins or
// ends at a support, whose guard is a bound, is no part of another contact.
EventKind kind_of(const Transition& transition, Index more, const ActiveSet& of_contacts) {
  const bool at_support = std::any_of(transition.contacts.begin(), transition.contacts.end(),
                                      [&](Index j) { return j >= static_cast<Index>(of_contacts.contacts()); });
  switch (transition.change) {
    case Transition::Change::spreads:
      return more == 0 || at_support ? EventKind::contact_spreads
             : more > 0              ? EventKind::contact_splits
                                     : EventKind::contacts_merge;
    case Transition::Change::gathers:
      return more < 0 && !at_support ? EventKind::contacts_merge : EventKind::contact_shrinks;
    case Transition::Change::splits:
      return more > 0 ? EventKind::contact_splits : EventKind::contact_opens;
    case Transition::Change::joins:
      return more < 0 ? EventKind::contacts_merge : EventKind::contact_closes;
    case Transition::Change::passes:
      return EventKind::contact_transfers;
    case Transition::Change::remeshed:
    case Transition::Change::continuum:
    case Transition::Change::unsupported:
    case Transition::Change::blocked:
      break;
  }
  assert(false);
  return EventKind::user;
}

// Behind none of these a point was found. `place`: of the bound behind which they lie.
BranchEnd end_before(const std::vector<Transition>& transitions, const std::string& place) {
  if (transitions.empty() || leads_on(transitions.back().change))
    return {.reason = EndReason::singular, .detail = with_place(nothing_behind_change, place)};
  const Transition& last = transitions.back();
  if (last.change == Transition::Change::blocked) return blocked_end(last.detail);
  const bool continuum = last.change == Transition::Change::continuum;
  return {.reason = continuum ? EndReason::equilibrium_family : EndReason::not_modelled,
          .detail = with_place(last.detail, place),
          .continuum = last.continuum};
}

// A bound of the mesh alone that another transition has left behind.
std::optional<Index> mesh_bound_behind(const System& system, const PathPoint& at, double tolerance) {
  for (auto j = static_cast<Index>(at.state.active_set.size()); j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && is_of_mesh(system, at.state, at.tangent, j, tolerance)) return j;
  return std::nullopt;
}

// By how much λ of a change that is known on the active set ahead lies before that of the bound where it was looked
// for, from which the path leads on to it: by the error of the mesh, or what the last stretch of the one active set has
// lost in round-off.
double lies_back_by(const PathPoint& bound, const PathPoint& change) {
  const double on = change.state.lambda - bound.state.lambda;
  return on * bound.tangent.dlambda < 0.0 ? std::abs(on) : 0.0;
}

// The corner's events: the transition's own, and what turns with it. `ahead` is the nearest point of the active set
// ahead.
void add_events(TraceTools& tools, const Corner& corner, const PathPoint& at, const Entered& entered,
                const PathPoint& ahead, CornerPassed& passed) {
  const Transition& transition = *entered.transition;
  Event event{.state = at.state,
              .arc = at.arc,
              .residual = at.residual,
              .unstable_before = corner.before.unstable,
              .unstable_after = ahead.count.unstable,
              .guards = transition.contacts,
              .continuum = transition.continuum};
  if (transition.change != Transition::Change::remeshed) {
    const ActiveSet &before = at.state.active_set, &behind = ahead.state.active_set;
    const Index more = tools.system.separate_contacts(behind) - tools.system.separate_contacts(before);
    event.kind = kind_of(transition, more, transition.change == Transition::Change::gathers ? behind : before);
    if (!begins_with_length(transition) && !begins_without_length(transition)) {
      event.state = entered.at.state;
      event.residual = entered.at.residual;
      event.lambda_uncertainty = entered.at.unsettled * corner.lambda_scale + lies_back_by(at, entered.at) +
                                 scatter_of(tools, entered, corner.lambda_scale);
    }
    passed.events.push_back(event);
    event.guards.clear();
    event.continuum.reset();
  }
  passed.signs = signs_behind_corner(tools, corner, ahead);
  add_turns(tools, corner.signs, passed.signs, event, passed.events);
}

// Whether one direction more, or less, gives way with a span that grows while λ goes on. Then another branch leaves
// there, or the active set is not the path's.
bool changes_count_at_corner(const Corner& corner, const PathPoint& at, const PathPoint& begin) {
  const std::optional<Index>&before = corner.before.unstable, &behind = begin.count.unstable;
  return before && behind && std::abs(*behind - *before) == 1 && begin.tangent.dlambda * at.tangent.dlambda > 0.0;
}

// The branch that leaves with a span that begins, across the path, where one direction more gives way: a pitchfork in
// the corner itself, where the span has no length. Its mode is that of the path's first point behind.
std::optional<BranchPoint> pitchfork_at_corner(TraceTools& tools, const Corner& corner, const PathPoint& begin) {
  if (begin.count.unstable <= corner.before.unstable) return std::nullopt;
  const Metric metric = tools.metric_on(begin.state.active_set, corner.lambda_scale);
  BranchPoint point = branch_point_before(tools.system, tools.corrector, metric, begin);
  if (point.type != BranchType::pitchfork || point.mode.dx.size() == 0) return std::nullopt;
  point.at_corner = true;
  return point;
}

// The branch point, which takes over the change of the count from the events that the corner has had.
void add_pitchfork(const PathPoint& at, const PathPoint& begin, BranchPoint point, std::vector<Event>& events) {
  const std::optional<Index> before = events.front().unstable_before;
  for (Event& event : events) event.unstable_after = before;
  events.push_back({.kind = EventKind::branch_point,
                    .state = at.state,
                    .arc = at.arc,
                    .residual = at.residual,
                    .unstable_before = before,
                    .unstable_after = begin.count.unstable,
                    .branching = std::make_shared<const BranchPoint>(std::move(point))});
}

}  // namespace

bool is_friction_bound(const System& system, const ActiveSet& active_set, Index guard) {
  return system.has_friction() && system.friction()->beyond_friction_bound(active_set, guard).has_value();
}

std::optional<Index> bound_passed_at(const System& system, const PathPoint& at, double tolerance) {
  std::optional<Index> lowest;
  for (auto j = static_cast<Index>(at.state.active_set.size()); j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && at.guard_rates[j] <= 0.0 && (!lowest || at.guards[j] < at.guards[*lowest]) &&
        !is_friction_bound(system, at.state.active_set, j))
      lowest = j;
  return lowest;
}

CornerPassed pass_bound(TraceTools& tools, Corner corner, Index bound) {
  CornerPassed passed{.at = std::move(corner.at), .without_progress = corner.without_progress};
  double tolerance = std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
  bool only_remeshed = true;
  for (;;) {
    const std::vector<Transition> transitions =
        tools.system.transitions(passed.at.state, passed.at.tangent, bound, tolerance);
    auto entered = enter_any(tools, transitions, passed.at, corner.before, corner.lambda_scale);
    if (!entered) {
      passed.end = end_before(transitions, tools.system.watched_place(passed.at.state, bound));
      return passed;
    }
    passed.strategies.insert(passed.strategies.end(), entered->strategies.begin(), entered->strategies.end());
    if (begins_with_length(*entered->transition)) {
      if (!entered->begin)
        entered->begin = begin_of(tools, *entered->transition, entered->at, passed.at, corner.lambda_scale);
      PathPoint& begin = entered->begin->at;
      if (!is_clear(tools, passed.at.state, begin.state)) {
        passed.end = {.reason = EndReason::not_modelled,
                      .detail = with_place("a member reaches a wall where its contact cannot be followed",
                                           tools.system.watched_place(passed.at.state, bound))};
        return passed;
      }
      std::optional<BranchPoint> pitchfork;
      const bool changes_count = changes_count_at_corner(corner, passed.at, begin);
      if (changes_count) pitchfork = pitchfork_at_corner(tools, corner, begin);
      if (changes_count && !pitchfork) {
        passed.end = end_before(transitions, tools.system.watched_place(passed.at.state, bound));
        return passed;
      }
      add_events(tools, corner, passed.at, *entered, begin, passed);
      if (pitchfork) add_pitchfork(passed.at, begin, std::move(*pitchfork), passed.events);
      passed.entered = EnteredActiveSet{.begin = std::move(begin)};
      if (holds_at(tools, entered->at)) passed.entered->first = std::move(entered->at);
      return passed;
    }
    add_events(tools, corner, passed.at, *entered, entered->at, passed);
    passed.at = std::move(entered->at);
    only_remeshed = only_remeshed && entered->transition->change == Transition::Change::remeshed;
    // Bounds that are reached together are passed one after the other: the new mesh may have shifted those behind the
    // first past their zero.
    const auto next = only_remeshed ? bound_passed_at(tools.system, passed.at, tools.options.guard_tolerance)
                                    : mesh_bound_behind(tools.system, passed.at, tools.options.guard_tolerance);
    if (!next) return passed;
    if (++passed.without_progress > most_bounds_at_one_place) {
      passed.end = {.reason = EndReason::no_continuation,
                    .detail = with_place("the mesh changes again and again at one point; use more elements",
                                         tools.system.watched_place(passed.at.state, *next))};
      return passed;
    }
    bound = *next;
    tolerance = tools.options.guard_tolerance;
  }
}

std::optional<Departure> departure_on(TraceTools& tools, const StepOrigin& origin, const Transition& transition) {
  const PathPoint& from = origin.point();
  auto point = enter(tools, transition, from, origin.metric.lambda_scale());
  if (!point) return std::nullopt;
  point->arc = from.arc;
  // The path goes on as was known: where it is singular, signs and counts at the start itself are any.
  Departure finer = origin.from;
  if (point->nearest.values.size() == 0) finer.last_pairs = origin.from.nearest();
  finer.point = std::move(*point);
  finer.before.reset();
  finer.eigenvalues_before.resize(0);
  return finer;
}

}  // namespace arcwall
