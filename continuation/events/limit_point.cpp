#include "continuation/events/limit_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/events/branch_point.hpp"
#include "continuation/events/branch_point_search.hpp"
#include "continuation/events/singular_locator.hpp"
#include "continuation/events/zero_search.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr double deep_turn = 0.1;  // what falls below this part of its values at both ends is looked at

// The tangent between two; of a point where K is twice singular its own may be any.
Direction mean(const Metric& metric, const Direction& a, const Direction& b) {
  return unit(metric, {.dx = a.dx + b.dx, .dlambda = a.dlambda + b.dlambda});
}

// Where λ turns.
struct Turning {
  State state;
  double uncertain = 0.0;  // of λ, besides how far the place is off
};

// Between two points beside a place where K is singular: there λ′ is blurred by what K's inverse makes of round-off,
// and the zero of it that was located with it. Beside it the path is exact, and smooth; but where a contact passes a
// point load λ has a kink, which the zero tells and a cubic rounds off.
Turning turning_between(const Metric& metric, const PathPoint& before, const PathPoint& after, const State& located) {
  constexpr double blur = 1e-7;  // that round-off may make of λ [scale of λ]
  const Segment segment(metric, before, after);
  const double L = segment.length();
  const auto t =
      cubic_turn(before.state.lambda, before.tangent.dlambda * L, after.state.lambda, after.tangent.dlambda * L);
  if (!t) return {.state = located};
  State between = segment.at(*t);
  const double blurred = blur * metric.lambda_scale();
  if (std::abs(between.lambda - located.lambda) > blurred) return {.state = located, .uncertain = blurred};
  return {.state = std::move(between)};
}

// The derivative along the tangent of what λ does work on, ∂Π/∂λ, from energies: on a mesh that slides its places are
// variables of the energy, too, which F_λ does not know of.
double work_from_energies(const System& system, const Metric& metric, const PathPoint& at) {
  constexpr double step = 1e-4;  // [path metric, scale of λ]
  const double h = step * metric.lambda_scale();
  const auto by_lambda = [&](State state) {
    const double lambda = state.lambda;
    state.lambda = lambda + h;
    const double more = system.energy(state);
    state.lambda = lambda - h;
    return (more - system.energy(state)) / (2.0 * h);
  };
  const auto beside = [&](double s) { return by_lambda(moved(at.state, at.tangent, s)); };
  return (beside(step) - beside(-step)) / (2.0 * step);
}

// How a limit point alone changes the number of negative eigenvalues: with K t_x = −t_λ F_λ,
//
//   t_xᵀ K t_x = −t_λ F_λᵀ t_x,
//
// which passes zero with t_λ. Zero where F_λᵀ t_x vanishes nearly, as at a branch point.
int change_at_limit(TraceTools& tools, const StepOrigin& origin, const PathPoint& at) {
  constexpr double nearly = 1e-6;
  if (!tools.system.slipping(at.state.active_set).empty()) return 0;  // friction has no energy whose rate would tell
  if (!tools.corrector.is_at(at.state)) tools.system.linearize(at.state, tools.workspace(at.state.active_set));
  const Linearization& now = tools.corrector.factorized().equations();
  if (now.N.nonZeros() > 0) return 0;
  const double work =
      now.B.cols() > 0 ? work_from_energies(tools.system, origin.metric, at) : now.F_lambda.dot(at.tangent.dx);
  if (std::abs(work) <= nearly * origin.metric.dual_norm(now.F_lambda)) return 0;
  return origin.from.signs.front() * work > 0.0 ? -1 : 1;
}

// The point that lies a little farther along the tangent than another, backwards where the distance is negative, with
// its count. Empty if there is none, or its count is not known.
std::optional<PathPoint> counted_beyond(TraceTools& tools, const StepOrigin& origin, const PathPoint& at,
                                        double distance) {
  const State guess = moved(at.state, at.tangent, distance);
  CorrectorResult result = tools.corrector.correct(guess, PlaneConstraint(origin.metric, guess, at.tangent, 0.0),
                                                   origin.metric, at.tangent, std::abs(distance));
  if (!result.converged()) return std::nullopt;
  PathPoint beyond = path_point(tools.system, origin.metric, std::move(result), at.tangent);
  decide_count(tools, beyond);
  return beyond.negative_eigenvalues ? std::optional(std::move(beyond)) : std::nullopt;
}

// Points on both sides of a limit point, so near that no other singular point lies between.
struct Sides {
  std::optional<PathPoint> before{}, after{};  // empty where the step's end is nearer, or there is none
  Index change = 0;                            // of the number of negative eigenvalues
  double distance = 0.0;
};

// Of a step that is shorter than counts take: points beyond its ends.
Sides sides_beyond(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  constexpr double distance = 1e-4;
  Sides sides{.before = counted_beyond(tools, origin, segment.from(), -distance),
              .after = counted_beyond(tools, origin, segment.to(), distance),
              .distance = distance};
  if (sides.before && sides.after)
    sides.change = *sides.after->negative_eigenvalues - *sides.before->negative_eigenvalues;
  return sides;
}

Sides sides_of(TraceTools& tools, const StepOrigin& origin, const Segment& segment, double t) {
  const auto count_at = [](const std::optional<PathPoint>& point, Index otherwise) {
    return point ? *point->negative_eigenvalues : otherwise;
  };
  const double L = segment.length();
  Sides sides;
  for (const double distance : {1e-4, 1e-3, 3e-5}) {
    const double t0 = t - distance / L, t1 = t + distance / L;
    Sides near{.distance = distance};
    if (t0 > 0.0 && !(near.before = counted_point(tools, origin, segment, t0))) continue;
    if (t1 < 1.0 && !(near.after = counted_point(tools, origin, segment, t1))) continue;
    near.change = count_at(near.after, *segment.to().negative_eigenvalues) -
                  count_at(near.before, *origin.from.negative_eigenvalues);
    sides = std::move(near);
    if (sides.change % 2 != 0) break;  // else there is a branch point, too
  }
  return sides;
}

// λ turns and the count does not change by one: two eigenvalues pass zero, or one touches it as the branch of a
// pitchfork goes through it from one side to the other. `length`: of the step.
void add_branch_point_at_limit(TraceTools& tools, const StepOrigin& origin, const Sides& sides, double length,
                               SingularPoint& limit) {
  const Metric& metric = origin.metric;
  const PathPoint &before = *sides.before, &after = *sides.after;
  Turning turning = turning_between(metric, before, after, limit.at.state);
  limit.at.state = std::move(turning.state);
  limit.uncertain = turning.uncertain;
  limit.at.tangent = mean(metric, before.tangent, after.tangent);
  limit.at.residual = tools.corrector.inspect(limit.at.state, metric, limit.at.tangent).residual;
  const auto pairs = tools.corrector.near_null(limit.at.state, metric.weights(), 2);
  const auto second = [](const NearNull& nearest) { return std::abs(nearest.values[1]); };
  SingularPlace place{
      .point = limit.at, .t = limit.place.t, .half_width = sides.distance / length, .change = limit.change};
  place.at_limit = pairs && pairs->values.size() > 1 && after.nearest.values.size() > 1 &&
                   second(*pairs) < 0.1 * second(after.nearest);
  place.touches = !place.at_limit;
  auto branching = std::make_shared<BranchPoint>(branch_point_at(tools.system, tools.corrector, metric, place));
  branching->lambda_uncertainty = sides.distance * std::abs(limit.at.tangent.dlambda);
  branching->mesh_artefact = tools.ties_contact_to_nodes(limit.at.state.active_set);
  if (place.touches) find_crossing_branch(tools.corrector, metric, *branching);
  limit.unconfirmed = place.touches && branching->ways.empty();
  limit.branching = std::move(branching);
}

// Where λ turns an eigenvalue passes zero. If another passes zero there in the same sense, Newton's method is at a loss
// there, as at any branch point, and the place is interpolated as theirs are. Empty where no such place is found.
std::optional<LocatedEvent> locate_multiple_turn(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  const Index before = *origin.from.negative_eigenvalues, after = *segment.to().negative_eigenvalues;
  if (std::abs(after - before) < 2) return std::nullopt;
  for (const SingularPlace& place : find_count_changes(tools.corrector, segment, origin.metric, before, after)) {
    if (place.multiplicity == 1) continue;
    const Sides sides = sides_of(tools, origin, segment, place.t);
    const PathPoint& first = sides.before ? *sides.before : segment.from();
    const PathPoint& last = sides.after ? *sides.after : segment.to();
    if (first.tangent.dlambda * last.tangent.dlambda < 0.0)
      return LocatedEvent{
          .place = {.what = EventPlace::What::detector, .which = 0, .t = place.t, .half_width = place.half_width},
          .point = point_at(tools, origin, place)};
  }
  return std::nullopt;
}

LocatedEvent locate_turn(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  if (auto multiple = locate_multiple_turn(tools, origin, segment)) return std::move(*multiple);
  return locate(tools, origin, {.what = EventPlace::What::detector, .which = 0, .t = 0.5, .half_width = 0.0},
                segment.to());
}

}  // namespace

// A limit point changes the count by one, right there; what else changes it are branch points: those before it come
// first, those behind it are left to the next step, and those at the same place are reported with it. How near to it
// the count is sure depends on the mesh.
SingularSearch find_limit_point(TraceTools& tools, const StepOrigin& origin, const PathPoint& to) {
  const Segment segment(origin.metric, origin.point(), to);
  const Index count_before = *origin.from.negative_eigenvalues, count_after = *to.negative_eigenvalues;
  LocatedEvent limit = locate_turn(tools, origin, segment);
  if (!limit.point) return {.clear = false, .failure = limit.failure};
  const double L = segment.length();
  const Index whole = count_after - count_before;
  Sides sides = sides_of(tools, origin, segment, limit.place.t);
  if (sides.before && *sides.before->negative_eigenvalues != count_before)
    return find_branch_points(tools, origin, *sides.before);
  if (std::abs(whole) == 1) {
    const int expected = change_at_limit(tools, origin, *limit.point);
    if (expected == -whole && L > shortest_telling_step) return {.clear = false};
    return {.points = {{.place = limit.place, .at = std::move(*limit.point), .change = whole}}};
  }
  SingularPoint point{.place = limit.place, .at = std::move(*limit.point), .change = sides.change};
  if (std::abs(sides.change) == 1) return {.points = {std::move(point)}};
  if ((!sides.before || !sides.after) && L <= shortest_telling_step) sides = sides_beyond(tools, origin, segment);
  if (!sides.before || !sides.after || sides.change % 2 != 0) {
    point.change = count_after - count_before;
    return {.points = {std::move(point)}, .clear = L <= shortest_telling_step};
  }
  // Where they do not, λ turns on none of the branches that pass each other there.
  if (L > shortest_telling_step && !Segment(origin.metric, *sides.before, *sides.after).follows_the_path())
    return {.clear = false};
  add_branch_point_at_limit(tools, origin, sides, L, point);
  return {.points = {std::move(point)}};
}

SingularSearch find_touching_limit(TraceTools& tools, const StepOrigin& origin, const Segment& segment) {
  if (!hides_two_zeros(tools.detectors, segment, deep_turn)) return {};
  const auto places = find_touches(tools.corrector, segment, origin.metric, Vanishing::turning,
                                   origin.from.zero_eigenvalues > 0, detector_noise);
  if (!places || places->size() == 2) return {.clear = segment.length() <= shortest_telling_step};
  if (places->empty()) return {};
  const SingularPlace& place = places->front();
  return {.points = {{.place = {.what = EventPlace::What::detector, .which = 0, .t = place.t, .half_width = 0.0},
                      .at = point_at(tools, origin, place),
                      .change = place.change,
                      .unconfirmed = place.touches}}};
}

bool hides_two_zeros(const std::vector<EventDetector>& detectors, const Segment& segment, double part) {
  // Between a point so near a corner and the corner itself nothing but round-off is seen.
  if (segment.length() <= coincidence_tolerance) return false;
  for (const EventDetector& detector : detectors) {
    if (!detector.integral) continue;
    const double v0 = detector.integral(segment.from()), v1 = detector.integral(segment.to());
    const double r0 = detector.value(segment.from()), r1 = detector.value(segment.to());
    if (sign_of(r0) == 0 || sign_of(r0) != sign_of(r1)) continue;
    const double sign = r0 > 0.0 ? 1.0 : -1.0, L = segment.length();
    // The steepest fall of the cubic against the sign of both ends: v′ is a parabola with end values r0, r1 and mean
    // (v1 − v0)/L, so its least value inside is below both when the mean is small enough.
    const double mean_rate = sign * (v1 - v0) / L, a = sign * r0, b = sign * r1;
    const double curvature = 3.0 * (a + b - 2.0 * mean_rate), slope = 2.0 * (3.0 * mean_rate - 2.0 * a - b);
    if (curvature <= 0.0) continue;
    const double t = -slope / (2.0 * curvature), bound = part > 0.0 ? part * std::min(a, b) : part;
    if (t > 0.0 && t < 1.0 && a + t * (slope + t * curvature) < bound) return true;
  }
  return false;
}

}  // namespace arcwall
