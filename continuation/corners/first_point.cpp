#include "continuation/corners/first_point.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "continuation/events/target_values.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

bool leads_on(Transition::Change change) {
  return change != Transition::Change::continuum && change != Transition::Change::unsupported &&
         change != Transition::Change::blocked;
}

bool begins_without_length(const Transition& transition) {
  return transition.change == Transition::Change::spreads && transition.quantity && transition.value == 0.0;
}

bool begins_with_length(const Transition& transition) {
  const Transition::Change change = transition.change;
  return (change == Transition::Change::spreads && !begins_without_length(transition)) ||
         (change == Transition::Change::splits && transition.quantity != nullptr) ||
         (change == Transition::Change::passes && transition.value > 0.0);
}

bool is_of_mesh(const System& system, const State& state, const Direction& forward, Index guard, double slack) {
  if (guard < static_cast<Index>(state.active_set.size())) return false;
  const std::vector<Transition> ahead = system.transitions(state, forward, guard, slack);
  return !ahead.empty() && ahead.front().change == Transition::Change::remeshed;
}

namespace {

constexpr double shortened_early = 0.3;  // of its length: a span that is entered early
constexpr double surely_below = 1e-4;    // of a guard where a new span is short

// Whether the place of a change is known on the active set ahead alone, by a quantity if there is one.
bool is_known_ahead(Transition::Change change) {
  return change == Transition::Change::gathers || change == Transition::Change::joins;
}

// The active set ahead: its metric, and a direction in which it is entered.
struct Ahead {
  Metric metric;
  Direction along{};
};

Ahead ahead_of(const TraceTools& tools, const Transition& transition, double lambda_scale) {
  const State& guess = transition.guess.get();
  Ahead ahead{.metric = tools.metric_on(guess.active_set, lambda_scale), .along = transition.forward};
  const bool is_known = transition.forward.dx.size() > 0 && ahead.metric.norm(transition.forward) > 0.0;
  if (!is_known) ahead.along = {.dx = Vector::Zero(guess.x.size()), .dlambda = 1.0};
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

// A contact that has just changed, or is new, and whose force or gap a change of mesh moves below zero.
std::optional<Index> contact_moved_below(const TraceTools& tools, const PathPoint& behind, const State& ahead) {
  const double tolerance = tools.options.guard_tolerance;
  bool may_be = ahead.active_set.size() > behind.state.active_set.size();
  for (Index j = 0; j < static_cast<Index>(behind.state.active_set.size()); ++j)
    may_be = may_be || (std::abs(behind.guards[j]) <= tolerance && behind.guard_rates[j] > 0.0);
  if (!may_be || ahead.active_set.empty()) return std::nullopt;
  Index lowest = 0;
  const double least = tools.system.guards(ahead).head(static_cast<Index>(ahead.active_set.size())).minCoeff(&lowest);
  return least < -tolerance ? std::optional(lowest) : std::nullopt;
}

// From a transition's guess to an equilibrium of the active set ahead. A new mesh moves the path by the error of its
// elements: where that would move it over a target value, or off one, the point is the one at which that quantity has
// the value of before; and where a contact has just changed, or one that is new would be inside, the one at which that
// has neither gap nor force. So what lay ahead still does, and what was met is met no more.
CorrectorResult arrive(TraceTools& tools, const Transition& transition, const PathPoint& from, const Ahead& ahead,
                       Effort effort) {
  constexpr double distance = 0.1;  // a generous guess [path metric]
  const auto corrected = [&](const State& guess, const PathConstraint& constraint) {
    CorrectorResult result =
        effort == Effort::patient
            ? tools.corrector.correct_patiently(guess, constraint, ahead.metric, ahead.along, distance)
            : tools.corrector.correct(guess, constraint, ahead.metric, ahead.along, distance);
    // A new mesh moves the path by next to nothing, but where nothing resists a correction may go anywhere.
    const bool stays = transition.change == Transition::Change::remeshed;
    if (result.converged() && stays && !(ahead.metric.distance(result.state, guess) <= distance))
      result.status = CorrectorStatus::diverged;
    return result;
  };
  const State& guess = transition.guess.get();
  const auto in_plane = [&] { return corrected(guess, PlaneConstraint(ahead.metric, guess, ahead.along, 0.0)); };
  const auto with_value = [&](const State& near) {
    return corrected(near, ValueConstraint(*transition.quantity, transition.value));
  };
  CorrectorResult result = transition.quantity ? with_value(guess) : in_plane();
  if (!result.converged() && transition.quantity && is_known_ahead(transition.change))
    if (const CorrectorResult near = in_plane(); near.converged()) result = with_value(near.state);
  if (!result.converged() || transition.change != Transition::Change::remeshed) return result;
  const auto moved_back = [&](const PathConstraint& constraint) {
    CorrectorResult back = corrected(result.state, constraint);
    return back.converged() ? back : result;
  };
  if (const TargetValue* const kept = value_moved_over(tools.options.target_values, from.state, result.state))
    return moved_back(ValueConstraint(*kept->quantity, kept->quantity->value(from.state)));
  if (const auto contact = contact_moved_below(tools, from, result.state))
    return moved_back(GuardConstraint(tools.system, *contact));
  return result;
}

// Whether a point is beyond a bound of its mesh.
bool is_beyond_mesh(const System& system, const PathPoint& at, double tolerance) {
  for (Index j = 0; j < at.guards.size(); ++j)
    if (at.guards[j] < -tolerance && is_of_mesh(system, at.state, at.tangent, j, tolerance)) return true;
  return false;
}

// Whether the guards hold within the error of the mesh, but for bounds of the mesh.
bool guards_hold(const TraceTools& tools, const State& state, const Direction& forward, const Vector& guards) {
  for (Index j = 0; j < guards.size(); ++j) {
    const double error = tools.options.mesh_error_of(state.active_set, j);
    if (guards[j] < -error && !is_of_mesh(tools.system, state, forward, j, error)) return false;
  }
  return true;
}

// Whether the side conditions hold at the first point behind a transition; behind one of the mesh they are the same.
// What is touched before that point where it has a length is found by the step to it.
bool holds(const TraceTools& tools, const Transition& transition, const State& from, const State& state,
           const Direction& forward) {
  const bool clear = begins_with_length(transition) ? !tools.system.penetrated_place(state, -penetration_tolerance)
                                                    : is_clear(tools, from, state);
  if (!clear) return false;
  return transition.change == Transition::Change::remeshed ||
         guards_hold(tools, state, forward, tools.system.guards(state));
}

// What the corrector arrived at, with its count.
PathPoint entered_point(TraceTools& tools, const Transition& transition, const Ahead& ahead, CorrectorResult result,
                        double arc) {
  if (transition.quantity && transition.quantity->rate(result.state, result.tangent) < 0.0)
    result.tangent = reversed(std::move(result.tangent));
  const Direction forward = transition.quantity ? result.tangent : ahead.along;
  PathPoint to = path_point(tools.system, ahead.metric, std::move(result), forward);
  to.arc = arc;
  decide_count(tools, to);
  to.count = tools.counter.count(to.state, to.negative_eigenvalues);
  return to;
}

// Whether a point behind a part's lifting off lies before that in λ. The free span of length d, at first without one,
// leaves the path's direction as it is, so it lies before by an error of the mesh alone. By round-off it does where
// nothing changes but what is in contact.
bool lies_back(const Transition& transition, const PathPoint& from, const PathPoint& at) {
  constexpr double roundoff = 1e-12;  // of the path metric
  const double rate = from.tangent.dlambda;
  return transition.change == Transition::Change::splits &&
         (at.state.lambda - from.state.lambda) * rate < -roundoff * rate * rate;
}

// A point of the active set ahead at which its new span has another length, reached from a point of that active set.
// Empty where it is farther off the tangent than may be trusted: there it may lie on another branch.
std::optional<PathPoint> with_span(TraceTools& tools, const Transition& transition, const Metric& metric,
                                   const PathPoint& from, double length) {
  constexpr double sure = 0.25;  // of the step
  const double rate = transition.quantity->rate(from.state, from.tangent);
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
// there is none below `most`.
std::optional<double> bound_of_span(const System& system, const Observable& length, const PathPoint& at, double most) {
  const Vector of_length = length.gradient(at.state).dx;
  std::optional<double> lowest;
  for (auto j = static_cast<Index>(at.state.active_set.size()); j < at.guards.size(); ++j) {
    if (at.guards[j] >= most) continue;
    const Row row = system.guard_gradient(at.state, j);
    const bool is_of_span =
        is_of_length(row) && std::abs(row.dx.dot(of_length)) > 0.999 * row.dx.norm() * of_length.norm();
    if (is_of_span && (!lowest || at.guards[j] < *lowest)) lowest = at.guards[j];
  }
  return lowest;
}

// Whether the guards hold where an active set begins with a short span, but for bounds of the mesh, of the length of
// that span, which grows, and of its mirror images, which are as long.
bool begins_within(const System& system, const Observable& length, const PathPoint& begin, double tolerance) {
  constexpr double as_long = 1e-6;  // in the scale of guards
  if (begin.guards.size() == 0 || begin.guards.minCoeff() >= -tolerance) return true;
  const std::optional<double> of_span = bound_of_span(system, length, begin, as_long - tolerance);
  for (Index j = 0; j < begin.guards.size(); ++j) {
    if (begin.guards[j] >= -tolerance) continue;
    const bool grows = of_span && std::abs(begin.guards[j] - *of_span) <= as_long && begin.guard_rates[j] > 0.0 &&
                       is_of_length(system.guard_gradient(begin.state, j));
    if (!grows && !is_of_mesh(system, begin.state, begin.tangent, j, tolerance)) return false;
  }
  return true;
}

// Whether a target value lies between a change of contact at which its quantity turns and a point behind that: on the
// active set that ends there it is not ahead.
bool value_lies_behind_turn(const std::vector<TargetValue>& targets, const PathPoint& change, const State& behind) {
  return std::any_of(targets.begin(), targets.end(), [&](const TargetValue& target) {
    return lies_between(target, change.state, behind) &&
           excess(target, change.state) * target.quantity->rate(change.state, change.tangent) >= 0.0;
  });
}

}  // namespace

bool is_clear(const TraceTools& tools, const State& from, const State& to) {
  return tools.system.check({.from = from, .to = to, .located = {{.penetration = penetration_tolerance}}}).fault ==
         StepVerdict::Fault::none;
}

bool holds_at(const TraceTools& tools, const PathPoint& at) {
  return !tools.system.penetrated_place(at.state, -penetration_tolerance) &&
         guards_hold(tools, at.state, at.tangent, at.guards);
}

Beginning begin_of(TraceTools& tools, const Transition& transition, const PathPoint& first, const PathPoint& from,
                   double lambda_scale) {
  constexpr double shortest = 1.0 / 16.0, tiny = 1e-5;  // of the first length
  constexpr double most_kept = 0.95, roundoff = 1e-9;   // of a length in one go, and of one
  Beginning beginning{.at = first};
  PathPoint& begin = beginning.at;
  begin.arc = from.arc;
  if (!transition.quantity) return beginning;
  const Metric metric = tools.metric_on(first.state.active_set, lambda_scale);
  const double whole = transition.quantity->value(first.state);
  const double least = (1.0 - roundoff) * std::max(shortest * whole, transition.least);
  double length = whole, kept = 0.5;
  const auto is_sure = [&] { return kept * length >= least; };
  const auto leaps = [&] {
    return kept * length >= tiny * whole && (value_lies_behind_turn(tools.options.target_values, from, begin.state) ||
                                             !is_clear(tools, from.state, begin.state));
  };
  while (kept < most_kept && (is_sure() || leaps())) {
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

std::optional<PathPoint> enter(TraceTools& tools, const Transition& transition, const PathPoint& from,
                               double lambda_scale, Effort effort) {
  const Ahead ahead = ahead_of(tools, transition, lambda_scale);
  CorrectorResult result = arrive(tools, transition, from, ahead, effort);
  if (!result.converged() || !holds(tools, transition, from.state, result.state, ahead.along)) return std::nullopt;
  return entered_point(tools, transition, ahead, std::move(result), from.arc);
}

double scatter_of(TraceTools& tools, const Entered& entered, double lambda_scale) {
  constexpr double beside = 1e-6, generous = 0.1;  // [path metric]
  const Transition& transition = *entered.transition;
  if (!transition.quantity || !is_known_ahead(transition.change)) return 0.0;
  const PathPoint& at = entered.at;
  const Metric metric = tools.metric_on(at.state.active_set, lambda_scale);
  double scatter = 0.0;
  for (const double off : {-beside, beside}) {
    const CorrectorResult again = tools.corrector.correct_patiently(
        moved(at.state, at.tangent, off), ValueConstraint(*transition.quantity, transition.value), metric, at.tangent,
        generous);
    if (again.converged()) scatter = std::max(scatter, std::abs(again.state.lambda - at.state.lambda));
  }
  return scatter;
}

namespace {

// Whether a guard is below zero at a point and sinks: the active set is none of the path's, however little that is. Of
// a part pressed on a wall that has hardly any length the pressure is hardly any, too, where the wall would have to
// pull. `error`: what the error of a mesh may make of guard j.
template <typename Error>
bool sinks(const System& system, const PathPoint& at, const Error& error) {
  for (Index j = 0; j < at.guards.size(); ++j)
    if (at.guards[j] < -error(j) && at.guard_rates[j] < 0.0 && !is_of_mesh(system, at.state, at.tangent, j, error(j)))
      return true;
  return false;
}

// A first point of the active set behind a transition from which it can be followed back to where its span is much
// shorter, and holds, its mesh too: there but for bounds of the length of the span itself. What is touched between the
// two is found by the step from there. Empty where there is none.
std::optional<PathPoint> first_early(TraceTools& tools, const Transition& transition, const PathPoint& from,
                                     double lambda_scale) {
  const Ahead ahead = ahead_of(tools, transition, lambda_scale);
  CorrectorResult result = arrive(tools, transition, from, ahead, Effort::usual);
  if (!result.converged()) return std::nullopt;
  PathPoint first = entered_point(tools, transition, ahead, std::move(result), from.arc);
  if (lies_back(transition, from, first)) return std::nullopt;
  const PathPoint begin = begin_of(tools, transition, first, from, lambda_scale).at;
  if (transition.quantity->value(begin.state) > shortened_early * transition.value) return std::nullopt;
  if (!begins_within(tools.system, *transition.quantity, begin, tools.options.guard_tolerance)) return std::nullopt;
  if (is_beyond_mesh(tools.system, begin, mesh_error)) return std::nullopt;
  return is_clear(tools, from.state, begin.state) ? std::optional(std::move(first)) : std::nullopt;
}

// Behind a transition an active set with a span at whose first length another bound is passed already, or which is not
// found with that length: it is entered where the span is shorter, and followed from there. `part` is that of the first
// length. Empty where no active set begins so.
std::optional<Entered> enter_early(TraceTools& tools, const Transition& transition, const PathPoint& from,
                                   double lambda_scale, double part) {
  if (!begins_with_length(transition) || !transition.quantity) return std::nullopt;
  Transition shorter = transition;
  shorter.value *= part;
  auto first = first_early(tools, shorter, from, lambda_scale);
  return first ? std::optional(Entered{.transition = &transition, .at = std::move(*first)}) : std::nullopt;
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
std::optional<PathPoint> in_sense_of_counts(const TraceTools& tools, const StabilityCount& before,
                                            const PathPoint& from, PathPoint at) {
  if (!agrees_with_counts(before, from, at)) {
    at.tangent = reversed(std::move(at.tangent));
    at.guard_rates = -at.guard_rates;
  }
  const auto error = [&](Index j) { return tools.options.mesh_error_of(at.state.active_set, j); };
  return sinks(tools.system, at, error) ? std::nullopt : std::optional(std::move(at));
}

// Whether a change of contact is known on neither side but by its state.
bool is_known_by_state(const Transition& transition) {
  return !transition.quantity && (is_known_ahead(transition.change) || transition.change == Transition::Change::splits);
}

// Whether no guard that vanishes where zones begin falls from there on: another of them would shrink.
bool zones_grow(const TraceTools& tools, const PathPoint& at) {
  const double tolerance = tools.options.guard_tolerance;
  for (auto j = static_cast<Index>(at.state.active_set.size()); j < at.guards.size(); ++j)
    if (std::abs(at.guards[j]) <= tolerance && at.guard_rates[j] < -tolerance) return false;
  return true;
}

// Whether a branch begins together with zones of no length: between there and a length the count changes, by an
// eigenvalue that is zero where they begin, as nearly as points there can be told apart. What is left of it is the
// error of the mesh, and its sign says nothing; that behind the change is the sign of its rate.
bool begins_with_branch(TraceTools& tools, PathPoint at, const PathPoint& with_length, double lambda_scale) {
  const std::optional<Index> behind = with_length.negative_eigenvalues;
  if (!at.negative_eigenvalues || !behind) return true;
  if (*at.negative_eigenvalues == *behind) return false;
  const Metric metric = tools.metric_on(at.state.active_set, lambda_scale);
  PathPoint ahead = with_length;
  find_pairs(tools, metric, at);
  find_pairs(tools, metric, ahead);
  if (at.nearest.values.size() == 0 || ahead.nearest.values.size() == 0) return true;
  const double here = at.nearest.values[0], rate = ahead.nearest.values[0] - here;
  return std::abs(here) * metric.distance(at.state, ahead.state) <= singular_point_accuracy * std::abs(rate);
}

// Whether a change lies where a quantity has a value, at which it is sought with patience before the transitions that
// come next are tried: one of them may leap over it.
bool is_sought(const Transition& transition) {
  return transition.quantity && transition.change == Transition::Change::gathers;
}

}  // namespace

std::optional<Entered> enter_any(TraceTools& tools, const std::vector<Transition>& transitions, const PathPoint& from,
                                 const StabilityCount& before, double lambda_scale) {
  std::optional<Entered> doubtful;
  const auto strategies_of = [&](const Transition& transition, Effort effort) {
    std::vector<Strategy> strategies;
    if (&transition != transitions.data()) strategies.push_back(Strategy::other_zone);
    if (effort == Effort::patient) strategies.push_back(Strategy::more_iterations);
    return strategies;
  };
  const auto early = [&](const Transition& transition, double part) {
    auto entered = enter_early(tools, transition, from, lambda_scale, part);
    if (entered) {
      entered->strategies = strategies_of(transition, Effort::usual);
      entered->strategies.push_back(Strategy::shorter_zone);
    }
    if (!entered || agrees_with_counts(before, from, entered->at)) return entered;
    if (!doubtful) doubtful = std::move(entered);
    return std::optional<Entered>();
  };
  for (const Effort effort : {Effort::usual, Effort::patient}) {
    for (const Transition& transition : transitions) {
      if (!leads_on(transition.change)) break;
      Effort taken = effort;
      auto at = enter(tools, transition, from, lambda_scale, taken);
      if (!at && is_sought(transition)) at = enter(tools, transition, from, lambda_scale, taken = Effort::patient);
      if (!at && effort == Effort::usual)
        if (auto entered = early(transition, 1.0)) return entered;
      if (!at) continue;
      if (is_known_by_state(transition)) at = in_sense_of_counts(tools, before, from, std::move(*at));
      if (!at) continue;
      // Counts that do not agree tell of a branch point in the corner. There the equations ahead are singular, too: the
      // branch is told from where the zone has a length.
      if (begins_without_length(transition)) {
        if (!zones_grow(tools, *at) || !agrees_with_counts(before, from, *at)) continue;
        const auto with_length = enter(tools, *std::next(&transition), from, lambda_scale, taken);
        if (with_length && begins_with_branch(tools, *at, *with_length, lambda_scale)) continue;
      }
      Entered entered{.transition = &transition, .at = std::move(*at), .strategies = strategies_of(transition, taken)};
      const bool is_gathered = transition.change == Transition::Change::gathers && transition.quantity;
      const bool has_length = begins_with_length(transition);
      const bool leaves_mesh = has_length && is_beyond_mesh(tools.system, entered.at, mesh_error);
      if (has_length && transition.quantity && (transition.least > 0.0 || leaves_mesh))
        entered.begin = begin_of(tools, transition, entered.at, from, lambda_scale);
      if (leaves_mesh && (!entered.begin || is_beyond_mesh(tools.system, entered.begin->at, mesh_error))) continue;
      const bool leaps = entered.begin && transition.least > 0.0 && entered.begin->ends_there;
      if (leaps ||
          (has_length && sinks(tools.system, entered.at, [&](Index) { return tools.options.guard_tolerance; })) ||
          ((has_length || is_gathered) && !agrees_with_counts(before, from, entered.at))) {
        if (!doubtful) doubtful = std::move(entered);
        continue;
      }
      if (!lies_back(transition, from, entered.at)) return entered;
    }
    if (effort == Effort::patient) break;
    for (const double part : {1.0, 0.5, 0.25})
      for (const Transition& transition : transitions) {
        if (!leads_on(transition.change)) break;
        if (auto entered = early(transition, part)) return entered;
      }
  }
  if (doubtful) doubtful->strategies.push_back(Strategy::unsure_zone);
  return doubtful;
}

}  // namespace arcwall
