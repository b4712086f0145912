#include "continuation/step/step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "continuation/corners/transitions.hpp"
#include "continuation/events/limit_point.hpp"
#include "continuation/events/target_values.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "continuation/step/predictor.hpp"

namespace arcwall {

namespace {

constexpr double near_change = 1e-4;  // gaps between contacts that are let pass before a change of contacts is left

StepOutcome outcome_of(CorrectorStatus failure) {
  switch (failure) {
    case CorrectorStatus::converged:
      return StepOutcome::accepted;
    case CorrectorStatus::too_many_iterations:
      return StepOutcome::too_many_iterations;
    case CorrectorStatus::diverged:
      return StepOutcome::diverged;
    case CorrectorStatus::complex_roots:
      return StepOutcome::complex_roots;
    case CorrectorStatus::singular:
      return StepOutcome::singular;
    case CorrectorStatus::not_finite:
      return StepOutcome::not_finite;
  }
  return StepOutcome::accepted;
}

StepOutcome outcome_of(StepVerdict::Fault fault) {
  switch (fault) {
    case StepVerdict::Fault::none:
      return StepOutcome::accepted;
    case StepVerdict::Fault::wall_left:
      return StepOutcome::obstructed;
    case StepVerdict::Fault::behind_end:
      return StepOutcome::behind_end;
    case StepVerdict::Fault::wall_crossed:
    case StepVerdict::Fault::penetration:
      return StepOutcome::penetration;
    case StepVerdict::Fault::blocked:
      return StepOutcome::blocked;
  }
  return StepOutcome::accepted;
}

// In which a step's turn is measured. Where λ alone makes a step longer than `max_motion`, λ₀ is taken so great that
// the structure's motion has an equal part in the tangent, unless it is round-off.
Metric turning_metric(const StepOrigin& origin, double s, double max_motion) {
  const Direction& t = origin.point().tangent;
  const double motion = std::max(std::sqrt(origin.metric.inner_x(t, t)), detector_noise), rate = std::abs(t.dlambda);
  if (s <= max_motion || rate <= motion * origin.metric.lambda_scale()) return origin.metric;
  return {origin.metric.weights(), rate / motion};
}

double angle_between(const Metric& metric, const Direction& a, const Direction& b) {
  const double cosine = metric.inner(a, b) / (metric.norm(a) * metric.norm(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// What closes the step. Off a branch point the component along the mode is prescribed, so that the step cannot fall
// back.
std::unique_ptr<PathConstraint> constraint_of(const TraceOptions& options, const StepOrigin& origin, double s) {
  const PathPoint& from = origin.point();
  if (origin.leaves_branch_point)
    return std::make_unique<PlaneConstraint>(origin.metric, from.state, origin.start.mode,
                                             s * origin.metric.inner(from.tangent, origin.start.mode));
  return step_constraint(options.method, origin.metric, from.state, from.tangent, s, options.control.get());
}

// From the best guess, and where that fails from the one along the tangent.
CorrectorResult corrected(TraceTools& tools, const StepOrigin& origin, double s, std::vector<Strategy>& strategies) {
  const PathPoint& from = origin.point();
  const auto constraint = constraint_of(tools.options, origin, s);
  if (origin.effort == Effort::patient)
    return tools.corrector.correct_patiently(moved(from.state, from.tangent, s), *constraint, origin.metric,
                                             from.tangent, s);
  CorrectorResult result = tools.corrector.correct(predicted(tools.system, tools.options.method, origin, s),
                                                   *constraint, origin.metric, from.tangent, s);
  if (result.converged() || !origin.from.before) return result;
  strategies.push_back(Strategy::tangent_guess);
  return tools.corrector.correct(moved(from.state, from.tangent, s), *constraint, origin.metric, from.tangent, s);
}

// Whether a step leads aside: its chord lies by more than half the turn off the mean of the tangents at its ends. Where
// a path bends one way the chord lies between both tangents, and where it bends to and fro by less the shorter the
// step. So either the step is too long for what it passes, or its end is on another branch that runs beside the first.
bool leads_aside(const Metric& metric, const PathPoint& from, const PathPoint& to) {
  constexpr double bends_back = 0.1;  // that a step may do [rad]
  const Direction &a = from.tangent, &b = to.tangent;
  const Direction mean{.dx = a.dx + b.dx, .dlambda = a.dlambda + b.dlambda};
  const Direction chord = difference(to.state, from.state);
  return angle_between(metric, mean, chord) > 0.5 * angle_between(metric, a, b) + bends_back;
}

// Whether the middle of a step shows nothing that its ends hide: neither of its halves leads aside, and its count of
// negative eigenvalues is none that both ends have passed. Without this a step that λ makes long could pass two folds
// that take each other back, and one whose corrections grew could end on a branch beside the first.
bool middle_agrees(TraceTools& tools, const StepOrigin& origin, const Metric& metric, const PathPoint& end) {
  const PathPoint& from = origin.point();
  const Segment segment(origin.metric, from, end);
  const ChordPlaneConstraint plane(origin.metric, from.state, end.state, 0.5);
  auto middle = correct_onto(tools, origin, plane, segment, 0.5).point;
  if (!middle || leads_aside(metric, from, *middle) || leads_aside(metric, *middle, end)) return false;
  const auto [fewest, most] = std::minmax({from.negative_eigenvalues, end.negative_eigenvalues});
  if (!fewest) return true;
  decide_count(tools, *middle);
  const std::optional<Index>& count = middle->negative_eigenvalues;
  return count && *count >= *fewest && *count <= *most;
}

// Why the end of a step is not the continuation of its start: it is far off the predictor, has turned too much or lies
// aside. At a kink of the path a step turns it by the same angle however short it is.
std::optional<StepOutcome> strayed(const System& system, const StepOrigin& origin, const Metric& metric,
                                   const StepEnd& end, double s, const StepOptions& options) {
  constexpr double over_a_kink = 1e-6;  // steps are no longer [path metric]
  const Direction chord = difference(end.point.state, origin.point().state);
  const bool is_short = origin.metric.norm(chord) <= 2.0 * s;
  if (is_short && s <= over_a_kink && system.kink_between(origin.point().state, end.point.state)) return std::nullopt;
  if (end.turn > options.max_turn) return StepOutcome::tangent_angle;
  const bool near = is_short && angle_between(metric, origin.point().tangent, chord) <= options.max_turn &&
                    !leads_aside(metric, origin.point(), end.point);
  return near ? std::nullopt : std::optional(StepOutcome::left_path);
}

// The step to the first kink before `ahead`: to just before it, or over it from there. The quantity that grows through
// it closes the step over it, since λ may turn. Empty: there is none.
struct StepToKink {
  CorrectorResult result{};
  bool is_over = false;
};

std::optional<StepToKink> step_to_kink(TraceTools& tools, const StepOrigin& origin, const State& ahead) {
  constexpr double before = 1e-9;  // the kink [path metric]
  const PathPoint& from = origin.point();
  const auto kink = origin.leaves_branch_point ? std::nullopt : tools.system.kink_between(from.state, ahead);
  if (!kink || !kink->past) return std::nullopt;
  const Observable& past = *kink->past;
  const double here = past.value(from.state), rate = apply(past.gradient(from.state), from.tangent);
  if (!(rate > 0.0)) return std::nullopt;
  const double distance = -here / rate;
  const bool is_over = distance <= 2.0 * before;
  const double beside = is_over ? kink_accuracy : -before, s = distance + beside;
  const ValueConstraint constraint(past, rate * beside);
  StepToKink step{
      .result = tools.corrector.correct(moved(from.state, from.tangent, s), constraint, origin.metric, from.tangent, s),
      .is_over = is_over};
  if (!step.result.converged() || (past.value(step.result.state) > 0.0) != is_over) return std::nullopt;
  const Direction& tangent = step.result.tangent;
  if (is_over && apply(past.gradient(step.result.state), tangent) < 0.0) step.result.tangent = reversed(tangent);
  return step;
}

// Whether a step over a kink has to be taken in parts: it turns too much, something changes on its way, or a contact
// slips over it, whose dissipation is an integral along the way.
bool is_stopped_by_kink(TraceTools& tools, const StepOrigin& origin, const CorrectorResult& result, double s) {
  const auto kink = tools.system.kink_between(origin.point().state, result.state);
  if (!kink) return false;
  if (!tools.system.slipping(result.state.active_set).empty()) return true;
  StepEnd end{.point = path_point(tools.system, origin.metric, result, origin.point().tangent)};
  const Metric metric = turning_metric(origin, s, tools.options.step.max);
  end.turn = angle_between(metric, origin.point().tangent, end.point.tangent);
  const auto passes = [&](const TargetValue& target) {
    return lies_between(target, origin.point().state, end.point.state);
  };
  const auto& targets = tools.options.target_values;
  return strayed(tools.system, origin, metric, end, s, tools.options.step) ||
         (!kink->is_slight && std::any_of(targets.begin(), targets.end(), passes)) ||
         (kink->is_slight &&
          hides_two_zeros(tools.detectors, Segment(origin.metric, origin.point(), end.point), -detector_noise)) ||
         end.point.negative_eigenvalues != origin.from.negative_eigenvalues ||
         signs_at(tools.detectors, end.point) != origin.from.signs;
}

// What vanishes with the guard that was landed on belongs to the change.
CheckedStep::LocatedEnd located_end(const StepOrigin& origin, const StepEnd& end) {
  CheckedStep::LocatedEnd located{.penetration = penetration_tolerance, .from = &origin.point().tangent};
  located.turns = origin.point().tangent.dlambda * end.point.tangent.dlambda < 0.0;
  if (end.landing) located.gap_seen = near_change;
  if (end.landing) located.guard = end.landing->guard;
  return located;
}

}  // namespace

StepTried try_step(TraceTools& tools, const StepOrigin& origin, double s) {
  const PathPoint& from = origin.point();
  StepTried tried{.attempt = {.arc = from.arc, .radius = s}};
  const auto rejected = [&](StepOutcome outcome, CorrectorStatus failure = CorrectorStatus::converged,
                            std::string where = {}) {
    tried.attempt.outcome = outcome;
    tried.result = Rejected{.outcome = outcome, .failure = failure, .where = std::move(where)};
    return std::move(tried);
  };

  CorrectorResult result = corrected(tools, origin, s, tried.attempt.strategies);
  std::optional<StepToKink> kink;
  if (!result.converged() || is_stopped_by_kink(tools, origin, result, s))
    kink = step_to_kink(tools, origin, result.converged() ? result.state : moved(from.state, from.tangent, s));
  if (kink) result = std::move(kink->result);
  const bool contracts = result.contracts;
  tried.attempt.iterations = result.iterations;
  tried.attempt.residual = result.residual;
  tried.attempt.roots = result.roots;
  if (!result.converged()) return rejected(outcome_of(result.status), result.status);
  if (auto why = tools.system.check({.from = from.state, .to = result.state}); why.fault != StepVerdict::Fault::none)
    return rejected(outcome_of(why.fault), CorrectorStatus::converged, std::move(why.place));

  const bool is_over_kink = kink && kink->is_over;
  const Direction forward = is_over_kink ? result.tangent : from.tangent;
  StepEnd end{.point = path_point(tools.system, origin.metric, std::move(result), forward), .over_kink = is_over_kink};
  const Metric metric = turning_metric(origin, s, tools.options.step.max);
  tried.attempt.turn = end.turn = angle_between(metric, from.tangent, end.point.tangent);
  if (const auto outcome = strayed(tools.system, origin, metric, end, s, tools.options.step); outcome && !is_over_kink)
    return rejected(*outcome);

  LandedStep landed = land_on_first_guard(tools, origin, std::move(end));
  if (!landed.end) return rejected(StepOutcome::event_not_located, landed.failure, std::move(landed.where));
  end = std::move(*landed.end);
  StepVerdict verdict =
      tools.system.check({.from = from.state, .to = end.point.state, .located = located_end(origin, end)});
  for (const Transition& layout : verdict.restarts)
    if (auto finer = departure_on(tools, origin, layout)) {
      tried.attempt.outcome = StepOutcome::contact_inserted;
      tried.result = Retry{.finer = std::move(*finer)};
      return tried;
    }
  if (verdict.fault != StepVerdict::Fault::none)
    return rejected(outcome_of(verdict.fault), CorrectorStatus::converged, std::move(verdict.place));
  decide_count(tools, end.point);
  // Eigenvalues that vanish behind the change have no sure sign there.
  if (end.landing && end.landing->singular) end.point.negative_eigenvalues.reset();
  if ((s > tools.options.step.max || !contracts) && !middle_agrees(tools, origin, metric, end.point))
    return rejected(StepOutcome::left_path);
  tried.result = std::move(end);
  return tried;
}

StepTried try_step_clear_of_singular(TraceTools& tools, const StepOrigin& origin, double s) {
  constexpr double beside_singular = 0.93;
  StepTried tried = try_step(tools, origin, s);
  const StepEnd* const end = std::get_if<StepEnd>(&tried.result);
  const bool ends_on_singular = end && !end->landing && !end->point.negative_eigenvalues;
  if (!ends_on_singular || !origin.from.negative_eigenvalues || tools.options.events != EventSearch::locate)
    return tried;
  tools.corrector.track_from(origin.from.nearest());
  StepTried shorter = try_step(tools, origin, beside_singular * s);
  const StepEnd* const other = std::get_if<StepEnd>(&shorter.result);
  if (!other || !other->point.negative_eigenvalues) return tried;
  shorter.attempt.strategies.push_back(Strategy::beside_singular);
  return shorter;
}

}  // namespace arcwall
