#include "continuation/step/landing.hpp"

#include <algorithm>
#include <utility>

#include "continuation/corners/corner.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr int max_landings = 100;  // guards that turn out to come before the one landed on

struct GuardCrossing {
  Index guard;
  double t;
};

// Branch points are interpolated: guards that are zero there (a flat part buckles off its wall) are known no better.
double unsure_at_start(const StepOrigin& origin, double tolerance) {
  return origin.leaves_branch_point ? singular_point_accuracy : tolerance;
}

// An active set may be entered a little before one of its validity bounds, on the way to where it is valid; and where
// the mesh is drawn anew just behind a change of contact the guard that was zero there is so within the error of the
// mesh.
bool rises_from_below(const TraceOptions& options, const PathPoint& from, const PathPoint& to, Index guard,
                      double unsure) {
  const bool is_contact = guard < static_cast<Index>(to.state.active_set.size());
  const double v = from.guards[guard];
  const double error = options.mesh_error_of(to.state.active_set, guard);
  return v < -unsure && (!is_contact || v >= -error) && from.guard_rates[guard] > 0.0 && to.guards[guard] > v;
}

// By how much guards are violated that were not before.
double slack_at(const TraceOptions& options, const StepOrigin& origin, const PathPoint& at) {
  const double tolerance = options.guard_tolerance;
  double slack = 0.0;
  for (Index j = 0; j < at.guards.size(); ++j)
    if (!rises_from_below(options, origin.point(), at, j, unsure_at_start(origin, tolerance)))
      slack = std::max(slack, -at.guards[j]);
  return slack;
}

std::optional<GuardCrossing> first_crossing(const TraceOptions& options, const StepOrigin& origin,
                                            const Segment& segment) {
  const double tolerance = options.guard_tolerance;
  const PathPoint &from = segment.from(), &to = segment.to();
  const double L = segment.length();
  const double unsure = unsure_at_start(origin, tolerance);
  std::optional<GuardCrossing> first;
  for (Index j = 0; j < to.guards.size(); ++j) {
    const double v0 = from.guards[j], r0 = from.guard_rates[j], v1 = to.guards[j], r1 = to.guard_rates[j];
    const bool touches = v0 <= tolerance && v0 >= -unsure;
    if (rises_from_below(options, from, to, j, unsure)) continue;
    if (v1 >= -tolerance && least_cubic_value(touches ? 0.0 : v0, r0 * L, v1, r1 * L) >= -tolerance) continue;
    const double t = segment.first_zero(v0, r0, v1, r1, tolerance).value_or(0.0);
    if (!first || t < first->t) first = GuardCrossing{.guard = j, .t = t};
  }
  return first;
}

// At the end of a parabola that begins at a point with its tangent.
Direction tangent_from(const Metric& metric, const PathPoint& from, const PathPoint& to) {
  const Direction chord = difference(to.state, from.state);
  const double L = metric.norm(chord);
  return unit(metric,
              {.dx = 2.0 / L * chord.dx - from.tangent.dx, .dlambda = 2.0 / L * chord.dlambda - from.tangent.dlambda});
}

// A guard that has just left zero, and in a long step seems to come back: its zero that is found is the old one.
bool lands_where_it_began(const StepOrigin& origin, double tolerance, const PathPoint& at, Index guard) {
  const PathPoint& from = origin.point();
  return from.guards[guard] <= tolerance && from.guard_rates[guard] > 0.0 &&
         origin.metric.distance(at.state, from.state) <= coincidence_tolerance;
}

// A contact that sticks at its bound, to round-off, as a step begins, and would slip: where the bound falls slowly its
// zero lies behind.
bool would_slip_at_once(const TraceTools& tools, const StepOrigin& origin, Index guard) {
  const PathPoint& from = origin.point();
  return is_friction_bound(tools.system, from.state.active_set, guard) &&
         std::abs(from.guards[guard]) <= tools.options.guard_tolerance && from.guard_rates[guard] < 0.0;
}

// Where a continuum of equilibria lies ahead, the equations are singular at the change: see Transition::from_singular.
bool is_singular_change(const TraceTools& tools, const PathPoint& at, const Landing& landing) {
  constexpr double singular = 1e-6;  // in the scale of guards
  if (landing.guard < static_cast<Index>(at.state.active_set.size()) || landing.slack > singular) return false;
  const double tolerance = std::max(tools.options.guard_tolerance, 2.0 * landing.slack);
  const auto ahead = tools.system.transitions(at.state, at.tangent, landing.guard, tolerance);
  return !ahead.empty() && (ahead.front().from_singular || ahead.front().change == Transition::Change::continuum);
}

// Onto the zero of one guard, with what the other guards say there.
LandedStep land_on(TraceTools& tools, const StepOrigin& origin, const StepEnd& end, const GuardCrossing& crossing) {
  const double tolerance = tools.options.guard_tolerance;
  const Segment segment(origin.metric, origin.point(), end.point);
  CorrectedPoint at = correct_onto(tools, origin, GuardConstraint(tools.system, crossing.guard), segment, crossing.t);
  if (!at.point && would_slip_at_once(tools, origin, crossing.guard))
    return {.end = StepEnd{.point = origin.point(), .landing = Landing{.guard = crossing.guard}}};
  if (!at.point || lands_where_it_began(origin, tolerance, *at.point, crossing.guard))
    return {.end = std::nullopt, .failure = at.status};
  Landing landing{.guard = crossing.guard, .slack = slack_at(tools.options, origin, *at.point)};
  landing.singular = is_singular_change(tools, *at.point, landing);
  if (landing.singular && segment.length() > coincidence_tolerance)
    at.point->tangent = tangent_from(origin.metric, origin.point(), *at.point);
  return {.end = StepEnd{.point = std::move(*at.point), .turn = end.turn, .landing = landing}};
}

// A point of a step at which a guard is below zero that holds at the step's end: before that it falls below zero and
// rises again, or nearly so by its values and rates at both ends, and then in fact. Empty where there is none.
std::optional<PathPoint> dip_before(TraceTools& tools, const StepOrigin& origin, const StepEnd& end) {
  constexpr double nearly = 0.1;  // of the lower of its values at both ends
  const double tolerance = tools.options.guard_tolerance;
  const PathPoint& from = origin.point();
  const Segment segment(origin.metric, from, end.point);
  const double L = segment.length();
  for (Index j = 0; j < end.point.guards.size(); ++j) {
    if ((end.landing && j == end.landing->guard) || from.guards[j] <= tolerance) continue;
    const double v0 = from.guards[j], r0 = from.guard_rates[j] * L;
    const double v1 = end.point.guards[j], r1 = end.point.guard_rates[j] * L;
    const auto t = cubic_turn(v0, r0, v1, r1);
    if (!t || r0 > 0.0 || least_cubic_value(v0, r0, v1, r1) >= nearly * std::min(v0, v1)) continue;
    const ChordPlaneConstraint plane(origin.metric, from.state, end.point.state, *t);
    auto dip = correct_onto(tools, origin, plane, segment, *t).point;
    if (dip && dip->guards[j] < -tolerance) return dip;
  }
  return std::nullopt;
}

}  // namespace

// Solves for the guard's zero, and for that of any guard that turns out to come before.
LandedStep land_on_first_guard(TraceTools& tools, const StepOrigin& origin, StepEnd end) {
  const double tolerance = tools.options.guard_tolerance;
  const auto crossing_before = [&](const StepEnd& last) {
    return last.point.guards.size() > 0
               ? first_crossing(tools.options, origin, Segment(origin.metric, origin.point(), last.point))
               : std::nullopt;
  };
  const auto dips = [&](StepEnd& last) {
    auto dip = dip_before(tools, origin, last);
    if (dip) last = {.point = std::move(*dip), .turn = last.turn};
    return dip.has_value();
  };
  auto crossing = crossing_before(end);
  if (!crossing) {
    if (!dips(end)) return {.end = std::move(end)};
    crossing = crossing_before(end);
  }
  CorrectorStatus failure = CorrectorStatus::converged;
  std::string where;
  for (int round = 0; round < max_landings && crossing; ++round) {
    LandedStep landed = land_on(tools, origin, end, *crossing);
    failure = landed.failure;
    if (!landed.end) {
      where = tools.system.watched_place(origin.point().state, crossing->guard);
      break;
    }
    end = std::move(*landed.end);
    if (end.landing->singular) return {.end = std::move(end)};
    if (end.landing->slack <= tolerance && !dips(end)) return {.end = std::move(end)};
    crossing = crossing_before(end);
  }
  return {.end = std::nullopt, .failure = failure, .where = std::move(where)};
}

}  // namespace arcwall
