#include "continuation/corners/transitions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "continuation/corners/corner.hpp"
#include "continuation/events/branch_point.hpp"
#include "continuation/events/target_values.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

constexpr int most_bounds_at_one_place = 50;
constexpr double shortened_early = 0.3;  // of its length: a span that is entered early
constexpr double surely_below = 1e-4;    // of a guard where a new span is short

// Of a transition that is an event.
EventKind kind_of(Transition::Change change) {
  switch (change) {
    case Transition::Change::spreads:
      return EventKind::contact_spreads;
    case Transition::Change::gathers:
      return EventKind::contact_gathers;
    case Transition::Change::splits:
      return EventKind::contact_opens;
    case Transition::Change::joins:
      return EventKind::contact_closes;
    case Transition::Change::passes:
      return EventKind::contact_passes;
    case Transition::Change::remeshed:
    case Transition::Change::continuum:
    case Transition::Change::unsupported:
      break;
  }
  assert(false);
  return EventKind::user;
}

// Whether there is a piece behind, or only a reason to end.
bool leads_on(Transition::Change change) {
  return change != Transition::Change::continuum && change != Transition::Change::unsupported;
}

// Behind none of these a point was found.
BranchEnd end_before(const std::vector<Transition>& transitions) {
  if (transitions.empty() || leads_on(transitions.back().change))
    return {.reason = EndReason::singular, .detail = "behind a change of contact"};
  const Transition& last = transitions.back();
  const bool continuum = last.change == Transition::Change::continuum;
  return {.reason = continuum ? EndReason::continuum : EndReason::unsupported,
          .detail = last.detail,
          .continuum = last.continuum};
}

// Whether the place of a change is known on the piece ahead alone, by a quantity if there is one.
bool is_known_ahead(Transition::Change change) {
  return change == Transition::Change::gathers || change == Transition::Change::joins;
}

// Whether the first point on the piece ahead lies a little beyond the bound, with a new stretch of some length.
bool begins_with_length(const Transition& transition) {
  const Transition::Change change = transition.change;
  return change == Transition::Change::spreads ||
         (change == Transition::Change::splits && transition.quantity != nullptr) ||
         (change == Transition::Change::passes && transition.value > 0.0);
}

// The piece ahead: its metric, and a direction in which it is entered.
struct Ahead {
  Metric metric;
  Direction along{};
};

Ahead ahead_of(const TraceTools& tools, const Transition& transition, double lambda_scale) {
  const State& guess = transition.guess;
  Ahead ahead{.metric = tools.metric_on(guess.piece, lambda_scale), .along = transition.forward};
  if (ahead.metric.norm(transition.forward) == 0.0) ahead.along = {.dx = Vector::Zero(guess.x.size()), .dlambda = 1.0};
  return ahead;
}

// A target value that a change of mesh moves the path over, or off.
const TargetValue* value_moved_over(const std::vector<TargetValue>& targets, const State& behind, const State& ahead) {
  const auto moved_over = [&](const TargetValue& target) {
    return lies_between(target, behind, ahead) || is_left(target, behind, ahead);
  };
  const auto found = std::find_if(targets.begin(), targets.end(), moved_over);
  return found == targets.end() ? nullptr : &*found;
}

// From a transition's guess to an equilibrium of the piece ahead. A new mesh moves the path by the error of its
// elements: where that would move it over a target value, or off one, the point is the one at which that quantity has
// the value of before. So what lay ahead still does, and what was met is met no more.
CorrectorResult arrive(TraceTools& tools, const Transition& transition, const PathPoint& from, const Ahead& ahead,
                       Effort effort) {
  constexpr double distance = 0.1;  // a generous guess [path metric]
  const auto corrected = [&](const State& guess, const PathConstraint& constraint) {
    return effort == Effort::patient
               ? tools.corrector.correct_patiently(guess, constraint, ahead.metric, ahead.along, distance)
               : tools.corrector.correct(guess, constraint, ahead.metric, ahead.along, distance);
  };
  const State& guess = transition.guess;
  const auto in_plane = [&] { return corrected(guess, PlaneConstraint(ahead.metric, guess, ahead.along, 0.0)); };
  const auto with_value = [&](const State& near) {
    return corrected(near, ValueConstraint(*transition.quantity, transition.value));
  };
  CorrectorResult result = transition.quantity ? with_value(guess) : in_plane();
  if (!result.converged() && transition.quantity && is_known_ahead(transition.change))
    if (const CorrectorResult near = in_plane(); near.converged()) result = with_value(near.state);
  if (!result.converged() || transition.change != Transition::Change::remeshed) return result;
  const TargetValue* const kept = value_moved_over(tools.options.target_values, from.state, result.state);
  if (!kept) return result;
  CorrectorResult moved_back =
      corrected(result.state, ValueConstraint(*kept->quantity, kept->quantity->value(from.state)));
  return moved_back.converged() ? moved_back : result;
}

// Whether behind a bound there is the same piece on another mesh: a state beyond it is none the worse.
bool is_of_mesh(const System& system, const State& state, const Direction& forward, Index guard, double slack) {
  if (guard < static_cast<Index>(state.piece.size())) return false;
  const std::vector<Transition> ahead = system.transitions(state, forward, guard, slack);
  return !ahead.empty() && ahead.front().change == Transition::Change::remeshed;
}

// Whether a point is beyond a bound of its mesh.
bool is_beyond_mesh(const System& system, const PathPoint& at, double tolerance) {
  for (Index j = 0; j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && is_of_mesh(system, at.state, at.tangent, j, tolerance)) return true;
  return false;
}

// Whether the side conditions hold at the first point of a piece, but for bounds of its mesh.
bool holds(const System& system, const Transition& transition, const State& state, const Direction& forward) {
  if (!system.admissible(state, -penetration_tolerance)) return false;
  if (transition.change == Transition::Change::remeshed) return true;
  const Vector guards = system.guards(state);
  for (Index j = 0; j < guards.size(); ++j)
    if (guards[j] < -mesh_error && !is_of_mesh(system, state, forward, j, mesh_error)) return false;
  return true;
}

// What the corrector arrived at, with its count.
PathPoint entered_point(TraceTools& tools, const Transition& transition, const Ahead& ahead, CorrectorResult result,
                        double arc) {
  if (transition.quantity && apply(transition.quantity->gradient(result.state), result.tangent) < 0.0)
    result.tangent = reversed(std::move(result.tangent));
  const Direction forward = transition.quantity ? result.tangent : ahead.along;
  PathPoint to = path_point(tools.system, ahead.metric, std::move(result), forward);
  to.arc = arc;
  decide_count(tools, to);
  to.count = tools.counter.count(to.state, to.negative_eigenvalues);
  return to;
}

// Where a piece begins, as far as it is followed back from its first point.
struct Beginning {
  PathPoint at;
  bool ends_there = false;  // nearer the bound the piece does not hold
};

// A transition and the first point behind it; where its piece begins before that, with a span that is shorter.
struct Entered {
  const Transition* transition;
  PathPoint at;
  std::optional<Beginning> begin{};
};

// Whether a point behind a part's lifting off lies before that in λ. The free span of length d, at first without one,
// leaves the path's direction as it is, so it lies before by an error of the mesh alone.
bool lies_back(const Transition& transition, const PathPoint& from, const PathPoint& at) {
  return transition.change == Transition::Change::splits &&
         (at.state.lambda - from.state.lambda) * from.tangent.dlambda < 0.0;
}

// A point of the piece ahead at which its new span has another length, reached from a point of that piece. Empty where
// it is farther off the tangent than may be trusted: there it may lie on another branch.
std::optional<PathPoint> with_span(TraceTools& tools, const Transition& transition, const Metric& metric,
                                   const PathPoint& from, double length) {
  constexpr double sure = 0.25;  // of the step
  const double rate = apply(transition.quantity->gradient(from.state), from.tangent);
  const double s = (length - transition.quantity->value(from.state)) / rate;
  const State guess = moved(from.state, from.tangent, s);
  CorrectorResult result =
      tools.corrector.correct(guess, ValueConstraint(*transition.quantity, length), metric, from.tangent, std::abs(s));
  if (!result.converged() || !(metric.distance(result.state, guess) <= sure * std::abs(s))) return std::nullopt;
  PathPoint at = path_point(tools.system, metric, std::move(result), from.tangent);
  at.arc = from.arc;
  return at;
}

// Whether a guard is a bound of a length alone: of a coordinate, or of the difference of two.
bool is_of_length(const Row& guard) {
  const double greatest = guard.dx.cwiseAbs().maxCoeff();
  const Index entries = (guard.dx.array() != 0.0).count(), equal = (guard.dx.array().abs() == greatest).count();
  return guard.dlambda == 0.0 && greatest > 0.0 && entries == equal && entries <= 2;
}

// The bound of the length that a new span has, which is the lowest of those that tell nothing but that; empty where
// there is none.
std::optional<double> bound_of_span(const System& system, const Observable& length, const PathPoint& at) {
  const Vector of_length = length.gradient(at.state).dx;
  std::optional<double> lowest;
  for (auto j = static_cast<Index>(at.state.piece.size()); j < at.guards.size(); ++j) {
    const Row row = system.guard_gradient(at.state, j);
    const bool is_of_span =
        is_of_length(row) && std::abs(row.dx.dot(of_length)) > 0.999 * row.dx.norm() * of_length.norm();
    if (is_of_span && (!lowest || at.guards[j] < *lowest)) lowest = at.guards[j];
  }
  return lowest;
}

// Whether the guards hold where a piece begins with a short span, but for bounds of the mesh, of the length of that
// span, which grows, and of its mirror images, which are as long.
bool begins_within(const System& system, const Observable& length, const PathPoint& begin, double tolerance) {
  constexpr double as_long = 1e-6;  // in the scale of guards
  if (begin.guards.size() == 0 || begin.guards.minCoeff() >= -tolerance) return true;
  const std::optional<double> of_span = bound_of_span(system, length, begin);
  for (Index j = 0; j < begin.guards.size(); ++j) {
    if (begin.guards[j] >= -tolerance) continue;
    const bool grows = of_span && std::abs(begin.guards[j] - *of_span) <= as_long && begin.guard_rates[j] > 0.0 &&
                       is_of_length(system.guard_gradient(begin.state, j));
    if (!grows && !is_of_mesh(system, begin.state, begin.tangent, j, tolerance)) return false;
  }
  return true;
}

// Whether a target value lies between a change of contact at which its quantity turns and a point behind that: on the
// piece that ends there it is not ahead.
bool value_lies_behind_turn(const std::vector<TargetValue>& targets, const PathPoint& change, const State& behind) {
  return std::any_of(targets.begin(), targets.end(), [&](const TargetValue& target) {
    return lies_between(target, change.state, behind) &&
           excess(target, change.state) * apply(target.quantity->gradient(change.state), change.tangent) >= 0.0;
  });
}

// Where a piece begins whose first point has a new span of some length: it is followed back towards spans of no length
// as long as it is followed surely, and holds, to a sixteenth; of shorter spans neither forces nor counts are sure.
// Only values that are met nowhere else are followed farther. So the first point is reached by a step like any other.
Beginning begin_of(TraceTools& tools, const Transition& transition, const PathPoint& first, const PathPoint& from,
                   double lambda_scale) {
  constexpr double shortest = 1.0 / 16.0, tiny = 1e-5;  // of the first length
  constexpr double most_kept = 0.95, roundoff = 1e-9;   // of a length in one go, and of one
  Beginning beginning{.at = first};
  PathPoint& begin = beginning.at;
  begin.arc = from.arc;
  if (!transition.quantity) return beginning;
  const Metric metric = tools.metric_on(first.state.piece, lambda_scale);
  const double whole = transition.quantity->value(first.state);
  const double least = (1.0 - roundoff) * std::max(shortest * whole, transition.least);
  double length = whole, kept = 0.5;
  const auto is_sure = [&] { return kept * length >= least; };
  const auto has_value = [&] {
    return kept * length >= tiny * whole && value_lies_behind_turn(tools.options.target_values, from, begin.state);
  };
  while (kept < most_kept && (is_sure() || has_value())) {
    auto nearer = with_span(tools, transition, metric, begin, kept * length);
    if (!nearer) {
      kept = 0.5 * (1.0 + kept);
      continue;
    }
    if (lies_back(transition, from, *nearer)) break;
    if (is_sure()) {
      beginning.ends_there = !begins_within(tools.system, *transition.quantity, *nearer, surely_below);
      if (beginning.ends_there) break;
      decide_count(tools, *nearer);
      nearer->count = tools.counter.count(nearer->state, nearer->negative_eigenvalues);
    } else {
      nearer->negative_eigenvalues = begin.negative_eigenvalues;
      nearer->count = begin.count;
    }
    begin = std::move(*nearer);
    length *= kept;
  }
  return beginning;
}

// Whether a guard is below zero at a point and sinks: the piece is none of the path's, however little that is. Of a
// part pressed on a wall that has hardly any length the pressure is hardly any, too, where the wall would have to pull.
bool sinks(const System& system, const PathPoint& at, double tolerance) {
  for (Index j = 0; j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && at.guard_rates[j] < 0.0 && !is_of_mesh(system, at.state, at.tangent, j, tolerance))
      return true;
  return false;
}

// A first point of the piece behind a transition from which it can be followed back to where its span is much shorter,
// and holds: there but for bounds of the length of the span itself. Empty where there is none.
std::optional<PathPoint> first_early(TraceTools& tools, const Transition& transition, const PathPoint& from,
                                     double lambda_scale) {
  const Ahead ahead = ahead_of(tools, transition, lambda_scale);
  CorrectorResult result = arrive(tools, transition, from, ahead, Effort::usual);
  if (!result.converged() || !tools.system.admissible(result.state, -penetration_tolerance)) return std::nullopt;
  PathPoint first = entered_point(tools, transition, ahead, std::move(result), from.arc);
  if (lies_back(transition, from, first)) return std::nullopt;
  const PathPoint begin = begin_of(tools, transition, first, from, lambda_scale).at;
  if (transition.quantity->value(begin.state) > shortened_early * transition.value) return std::nullopt;
  if (!begins_within(tools.system, *transition.quantity, begin, tools.options.guard_tolerance)) return std::nullopt;
  return tools.system.admissible(begin.state, -penetration_tolerance) ? std::optional(std::move(first)) : std::nullopt;
}

// Behind a transition a piece with a span at whose first length another bound is passed already, or which is not found
// with that length: it is entered where the span is shorter, and followed from there. Empty where no piece begins so.
std::optional<Entered> enter_early(TraceTools& tools, const std::vector<Transition>& transitions, const PathPoint& from,
                                   double lambda_scale) {
  for (const double part : {1.0, 0.25}) {
    for (const Transition& transition : transitions) {
      if (!leads_on(transition.change)) break;
      if (!begins_with_length(transition) || !transition.quantity) continue;
      Transition shorter = transition;
      shorter.value *= part;
      if (auto first = first_early(tools, shorter, from, lambda_scale))
        return Entered{.transition = &transition, .at = std::move(*first)};
    }
  }
  return std::nullopt;
}

// Along a path the sense of λ turns where the number of unstable directions goes over from even to odd, and nowhere
// else. Whether a point behind a change of contact agrees with that, as far as counts are known.
bool agrees_with_counts(const StabilityCount& before, const PathPoint& from, const PathPoint& at) {
  if (!before.unstable || !at.count.unstable) return true;
  const double sense = (*before.unstable + *at.count.unstable) % 2 == 0 ? 1.0 : -1.0;
  return sense * from.tangent.dlambda * at.tangent.dlambda >= 0.0;
}

// On another mesh the path's direction tells its sense; where a change of contact is known on neither side but by its
// state, the counts do. What sinks below its bound in that sense is not the path's. Empty then.
std::optional<PathPoint> in_sense_of_counts(const System& system, const StabilityCount& before, const PathPoint& from,
                                            PathPoint at, double tolerance) {
  if (!agrees_with_counts(before, from, at)) {
    at.tangent = reversed(std::move(at.tangent));
    at.guard_rates = -at.guard_rates;
  }
  return sinks(system, at, tolerance) ? std::nullopt : std::optional(std::move(at));
}

// Whether a change of contact is known on neither side but by its state.
bool is_known_by_state(const Transition& transition) {
  return !transition.quantity && (is_known_ahead(transition.change) || transition.change == Transition::Change::splits);
}

// Whether a change lies where a quantity has a value, at which it is sought with patience before the transitions that
// come next are tried: one of them may leap over it.
bool is_sought(const Transition& transition) {
  return transition.quantity && transition.change == Transition::Change::gathers;
}

// The first of the transitions behind which a point is found, and better one that does not lie back. Where none is,
// they are entered early: what begins at the corner comes before what is farther off. Then all are tried again with
// patience. Last comes what is not sure to hold ahead, or does not hold between there and the bound, or has a count
// against which λ does not turn: with its length there may be a second equilibrium behind the next fold, from which the
// path would come back; and at a pitchfork in the corner the count is right.
std::optional<Entered> enter_any(TraceTools& tools, const std::vector<Transition>& transitions, const PathPoint& from,
                                 const StabilityCount& before, double lambda_scale) {
  std::optional<Entered> doubtful;
  for (const Effort effort : {Effort::usual, Effort::patient}) {
    std::optional<Entered> back;
    for (const Transition& transition : transitions) {
      if (!leads_on(transition.change)) break;
      auto at = enter(tools, transition, from, lambda_scale, effort);
      if (!at && is_sought(transition)) at = enter(tools, transition, from, lambda_scale, Effort::patient);
      if (!at) continue;
      if (is_known_by_state(transition))
        at = in_sense_of_counts(tools.system, before, from, std::move(*at), mesh_error);
      if (!at) continue;
      Entered entered{.transition = &transition, .at = std::move(*at)};
      const bool is_gathered = transition.change == Transition::Change::gathers && transition.quantity;
      const bool has_length = begins_with_length(transition);
      const bool leaves_mesh = has_length && is_beyond_mesh(tools.system, entered.at, mesh_error);
      if (has_length && transition.quantity && (transition.least > 0.0 || leaves_mesh))
        entered.begin = begin_of(tools, transition, entered.at, from, lambda_scale);
      if (leaves_mesh && (!entered.begin || is_beyond_mesh(tools.system, entered.begin->at, mesh_error))) continue;
      const bool leaps = entered.begin && transition.least > 0.0 && entered.begin->ends_there;
      if (leaps || (has_length && sinks(tools.system, entered.at, tools.options.guard_tolerance)) ||
          ((has_length || is_gathered) && !agrees_with_counts(before, from, entered.at))) {
        if (!doubtful) doubtful = std::move(entered);
        continue;
      }
      if (!lies_back(transition, from, entered.at)) return entered;
      if (!back) back = std::move(entered);
    }
    if (back) return back;
    if (effort == Effort::usual)
      if (auto early = enter_early(tools, transitions, from, lambda_scale)) return early;
  }
  return doubtful;
}

// Bounds that are reached together are passed one after the other, and those behind the first may have been shifted
// past their zero by the new mesh: the lowest one. A span that has just begun may still be shorter than its bound, and
// grows.
std::optional<Index> shifted_bound(const PathPoint& at, double tolerance) {
  std::optional<Index> lowest;
  for (auto j = static_cast<Index>(at.state.piece.size()); j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && at.guard_rates[j] <= 0.0 && (!lowest || at.guards[j] < at.guards[*lowest]))
      lowest = j;
  return lowest;
}

// A bound of the mesh alone that another transition has left behind.
std::optional<Index> mesh_bound_behind(const System& system, const PathPoint& at, double tolerance) {
  for (auto j = static_cast<Index>(at.state.piece.size()); j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && is_of_mesh(system, at.state, at.tangent, j, tolerance)) return j;
  return std::nullopt;
}

// By how much λ of a change that is known on the piece ahead lies before that of the bound where it was looked for,
// from which the path leads on to it: by the error of the mesh, or what the last stretch of the one piece has lost in
// round-off.
double lies_back_by(const PathPoint& bound, const PathPoint& change) {
  const double on = change.state.lambda - bound.state.lambda;
  return on * bound.tangent.dlambda < 0.0 ? std::abs(on) : 0.0;
}

// The corner's events: the transition's own, and what turns with it. `ahead` is the nearest point of the piece ahead.
void add_events(const TraceTools& tools, const Corner& corner, const PathPoint& at, const Entered& entered,
                const PathPoint& ahead, std::vector<Event>& events) {
  const Transition& transition = *entered.transition;
  Event event{.state = at.state,
              .arc = at.arc,
              .residual = at.residual,
              .unstable_before = corner.before.unstable,
              .unstable_after = ahead.count.unstable,
              .guards = transition.contacts,
              .continuum = transition.continuum};
  if (transition.change != Transition::Change::remeshed) {
    event.kind = kind_of(transition.change);
    if (!begins_with_length(transition)) {
      event.state = entered.at.state;
      event.residual = entered.at.residual;
      event.localised = entered.at.unsettled * corner.lambda_scale + lies_back_by(at, entered.at);
    }
    events.push_back(event);
    event.guards.clear();
    event.continuum.reset();
  }
  add_turns(tools, corner.signs, ahead, event, events);
}

// Where stability is lost with a span that grows while λ goes on, another branch leaves with the span, across the path:
// a pitchfork in the corner itself, where the span has no length. Its mode is that of the path's first point behind.
std::optional<BranchPoint> pitchfork_at_corner(TraceTools& tools, const Corner& corner, const PathPoint& at,
                                               const PathPoint& begin) {
  const std::optional<Index>&before = corner.before.unstable, &behind = begin.count.unstable;
  const bool goes_on = begin.tangent.dlambda * at.tangent.dlambda > 0.0;
  if (!(before && behind && *behind == *before + 1 && goes_on)) return std::nullopt;
  const Metric metric = tools.metric_on(begin.state.piece, corner.lambda_scale);
  BranchPoint point = branch_point_before(tools.system, tools.corrector, metric, begin);
  if (point.type != BranchType::symmetric || point.mode.dx.size() == 0) return std::nullopt;
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

CornerPassed pass_bound(TraceTools& tools, Corner corner, Index bound) {
  CornerPassed passed{.at = std::move(corner.at), .without_progress = corner.without_progress};
  double tolerance = std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
  bool only_remeshed = true;
  for (;;) {
    const std::vector<Transition> transitions =
        tools.system.transitions(passed.at.state, passed.at.tangent, bound, tolerance);
    auto entered = enter_any(tools, transitions, passed.at, corner.before, corner.lambda_scale);
    if (!entered) {
      passed.end = end_before(transitions);
      return passed;
    }
    if (begins_with_length(*entered->transition)) {
      if (!entered->begin)
        entered->begin = begin_of(tools, *entered->transition, entered->at, passed.at, corner.lambda_scale);
      PathPoint& begin = entered->begin->at;
      add_events(tools, corner, passed.at, *entered, begin, passed.events);
      if (auto pitchfork = pitchfork_at_corner(tools, corner, passed.at, begin))
        add_pitchfork(passed.at, begin, std::move(*pitchfork), passed.events);
      passed.entered = EnteredPiece{.begin = std::move(begin), .first = std::move(entered->at)};
      return passed;
    }
    add_events(tools, corner, passed.at, *entered, entered->at, passed.events);
    passed.at = std::move(entered->at);
    only_remeshed = only_remeshed && entered->transition->change == Transition::Change::remeshed;
    const auto next = only_remeshed ? shifted_bound(passed.at, tools.options.guard_tolerance)
                                    : mesh_bound_behind(tools.system, passed.at, tools.options.guard_tolerance);
    if (!next) {
      if (!only_remeshed)
        for (Event& event : passed.events) event.state = passed.at.state;
      return passed;
    }
    if (++passed.without_progress > most_bounds_at_one_place) {
      passed.end = {.reason = EndReason::no_ray, .detail = "the mesh keeps changing at one point; try a finer one"};
      return passed;
    }
    bound = *next;
    tolerance = tools.options.guard_tolerance;
  }
}

std::optional<PathPoint> enter(TraceTools& tools, const Transition& transition, const PathPoint& from,
                               double lambda_scale, Effort effort) {
  const Ahead ahead = ahead_of(tools, transition, lambda_scale);
  CorrectorResult result = arrive(tools, transition, from, ahead, effort);
  if (!result.converged() || !holds(tools.system, transition, result.state, ahead.along)) return std::nullopt;
  return entered_point(tools, transition, ahead, std::move(result), from.arc);
}

namespace {

// The start of a step on the piece of a transition from it.
std::optional<Departure> departure_on(TraceTools& tools, const StepOrigin& origin,
                                      const std::optional<Transition>& transition) {
  const PathPoint& from = origin.point();
  if (!transition) return std::nullopt;
  auto point = enter(tools, *transition, from, origin.metric.lambda_scale());
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

}  // namespace

std::optional<Departure> with_new_contact(TraceTools& tools, const StepOrigin& origin, const State& violated,
                                          double margin) {
  const PathPoint& from = origin.point();
  return departure_on(tools, origin, tools.system.with_inserted_contact(from.state, from.tangent, violated, margin));
}

std::optional<Departure> with_mesh_for_landing(TraceTools& tools, const StepOrigin& origin, const State& end,
                                               Index guard) {
  const PathPoint& from = origin.point();
  return departure_on(tools, origin, tools.system.with_mesh_for_landing(from.state, from.tangent, end, guard));
}

}  // namespace arcwall
