#include "continuation/corners/transitions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "continuation/corners/corner.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

namespace {

constexpr int most_bounds_at_one_place = 50;

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

// Whether the first point on the piece ahead lies a little beyond the bound, with a new stretch of some length.
bool begins_with_length(Transition::Change change) {
  return change == Transition::Change::spreads || change == Transition::Change::splits;
}

// A transition and the first point behind it.
struct Entered {
  const Transition* transition;
  PathPoint at;
};

// The first of the transitions behind which a point is found; all are tried again with patience where none is.
std::optional<Entered> enter_any(TraceTools& tools, const std::vector<Transition>& transitions, const PathPoint& from,
                                 double lambda_scale) {
  for (const Effort effort : {Effort::usual, Effort::patient})
    for (const Transition& transition : transitions) {
      if (!leads_on(transition.change)) break;
      if (auto at = enter(tools, transition, from, lambda_scale, effort))
        return Entered{.transition = &transition, .at = std::move(*at)};
    }
  return std::nullopt;
}

// Bounds that are reached together are passed one after the other, and those behind the first may have been shifted
// past their zero by the new mesh.
std::optional<Index> shifted_bound(const PathPoint& at, double tolerance) {
  const auto contacts = static_cast<Index>(at.state.piece.size());
  if (at.guards.size() == contacts) return std::nullopt;
  Index bound = 0;
  if (at.guards.tail(at.guards.size() - contacts).minCoeff(&bound) >= -tolerance) return std::nullopt;
  return contacts + bound;
}

// The corner's events: the transition's own, and what turns with it.
void add_events(const TraceTools& tools, const Corner& corner, const PathPoint& at, const Entered& entered,
                std::vector<Event>& events) {
  const Transition& transition = *entered.transition;
  Event event{.state = at.state,
              .arc = at.arc,
              .residual = at.residual,
              .unstable_before = corner.before.unstable,
              .unstable_after = entered.at.count.unstable,
              .guards = transition.contacts};
  if (transition.change != Transition::Change::remeshed) {
    event.kind = kind_of(transition.change);
    if (!begins_with_length(transition.change)) {
      event.state = entered.at.state;
      event.residual = entered.at.residual;
    }
    events.push_back(event);
    event.guards.clear();
  }
  add_turns(tools, corner.signs, entered.at, event, events);
}

}  // namespace

CornerPassed pass_bound(TraceTools& tools, Corner corner, Index bound) {
  CornerPassed passed{.at = std::move(corner.at), .without_progress = corner.without_progress};
  double tolerance = std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
  for (;;) {
    const std::vector<Transition> transitions =
        tools.system.transitions(passed.at.state, passed.at.tangent, bound, tolerance);
    auto entered = enter_any(tools, transitions, passed.at, corner.lambda_scale);
    if (!entered) {
      passed.end = end_before(transitions);
      return passed;
    }
    add_events(tools, corner, passed.at, *entered, passed.events);
    if (begins_with_length(entered->transition->change)) {
      passed.ahead = std::move(entered->at);
      return passed;
    }
    passed.at = std::move(entered->at);
    if (entered->transition->change != Transition::Change::remeshed) return passed;
    const auto next = shifted_bound(passed.at, tools.options.guard_tolerance);
    if (!next) return passed;
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
  constexpr double distance = 0.1;  // a generous guess [path metric]
  constexpr double slack = 1e-6;    // of guards that were near zero on the piece behind, too
  const System& system = tools.system;
  const State& guess = transition.guess;
  const Metric metric = tools.metric_on(guess.piece, lambda_scale);
  const bool oriented = metric.norm(transition.forward) > 0.0;
  const Direction along = oriented ? transition.forward : Direction{.dx = Vector::Zero(guess.x.size()), .dlambda = 1.0};
  const auto corrected = [&](const PathConstraint& constraint) {
    return effort == Effort::patient ? tools.corrector.correct_patiently(guess, constraint, metric, along, distance)
                                     : tools.corrector.correct(guess, constraint, metric, along, distance);
  };
  CorrectorResult result = transition.quantity ? corrected(ValueConstraint(*transition.quantity, transition.value))
                                               : corrected(PlaneConstraint(metric, guess, along, 0.0));
  if (!result.converged() || !system.admissible(result.state, -penetration_tolerance)) return std::nullopt;
  if (transition.change != Transition::Change::remeshed && (system.guards(result.state).array() < -slack).any())
    return std::nullopt;
  if (transition.quantity && apply(transition.quantity->gradient(result.state), result.tangent) < 0.0)
    result.tangent = reversed(std::move(result.tangent));
  const Direction forward = transition.quantity ? result.tangent : along;
  PathPoint to = path_point(system, metric, std::move(result), forward);
  to.arc = from.arc +
           (begins_with_length(transition.change) ? std::abs(to.state.lambda - from.state.lambda) / lambda_scale : 0.0);
  decide_count(tools, to);
  to.count = tools.counter.count(to.state, to.negative_eigenvalues);
  return to;
}

std::optional<Departure> with_new_contact(TraceTools& tools, const StepOrigin& origin, const State& violated,
                                          double margin) {
  const PathPoint& from = origin.point();
  const auto transition = tools.system.with_inserted_contact(from.state, from.tangent, violated, margin);
  if (!transition) return std::nullopt;
  auto point = enter(tools, *transition, from, origin.metric.lambda_scale());
  if (!point) return std::nullopt;
  point->arc = from.arc;
  Departure finer = origin.from;
  if (point->nearest.values.size() == 0) finer.last_pairs = origin.from.nearest();
  finer.point = std::move(*point);
  finer.before.reset();
  finer.eigenvalues_before.resize(0);
  finer.negative_eigenvalues = finer.point.negative_eigenvalues;
  finer.count_after = finer.point.count;
  return finer;
}

}  // namespace arcwall
