#include "continuation/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "continuation/arc_step.hpp"
#include "continuation/branch_start.hpp"
#include "continuation/corners/friction_corner.hpp"
#include "continuation/lambda_scale.hpp"
#include "continuation/stops.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

// A step is tried again with one contact more at its start so often; from then on it is made shorter, so that the
// attempts at an arc come to an end whatever the system inserts.
constexpr int most_insertions = 50;

// Why the attempts at an arc ended without one; `why` is what became of them.
BranchEnd end_of_attempts(const TraceOptions& options, const std::optional<Rejected>& why) {
  const bool controlled = options.method == PathMethod::load || options.method == PathMethod::displacement;
  if (why && why->outcome == StepOutcome::obstructed)
    return {.reason = EndReason::wall_end,
            .detail = with_place("a closed contact reached the end of its wall", why->where)};
  if (why && why->outcome == StepOutcome::behind_end)
    return {.reason = EndReason::wall_end,
            .detail =
                "the structure would enter a wall from beyond its open end, where it has no contact surface; a closed "
                "outline has one all around"};
  if (why && why->outcome == StepOutcome::blocked) return blocked_end(why->where);
  if (controlled)
    return {.reason = EndReason::control_turns,
            .detail = "the controlled quantity turns back; use path.method = \"spherical\""};
  if (why && why->outcome == StepOutcome::penetration)
    return {.reason = EndReason::not_modelled,
            .detail = with_place("a member reaches a wall where its contact cannot be followed", why->where)};
  if (why && why->failure == CorrectorStatus::singular)
    return {.reason = EndReason::singular, .detail = "the tangent stiffness is singular ahead"};
  if (why && why->failure == CorrectorStatus::not_finite)
    return {.reason = EndReason::not_finite, .detail = "a step leads to numbers that are not finite"};
  return {.reason = EndReason::min_step,
          .detail = with_place("no step above path.min_step converges", why ? why->where : std::string())};
}

// Of two attempts the one that says why the branch ends: one that found no equilibrium does not take back that the
// equilibrium before it had left its wall.
Rejected telling(const std::optional<Rejected>& before, const Rejected& now) {
  const auto found_none = [](StepOutcome outcome) {
    return outcome == StepOutcome::too_many_iterations || outcome == StepOutcome::diverged ||
           outcome == StepOutcome::complex_roots || outcome == StepOutcome::singular ||
           outcome == StepOutcome::not_finite;
  };
  return before && before->outcome == StepOutcome::obstructed && found_none(now.outcome) ? *before : now;
}

void tell_ledger(const TraceOptions& options, const ArcAttempt& attempt) {
  if (!options.ledger) return;
  StepAttempt row = attempt.ledger;
  if (const auto* const accepted = std::get_if<Accepted>(&attempt.result)) {
    row.outcome = StepOutcome::accepted;
    row.accepted = &accepted->arc;
  }
  options.ledger(row);
}

// The bounds of an active set that are near at a point and sink along the path, the one that is reached first before
// others.
std::vector<Landing> near_bounds(const PathPoint& at) {
  constexpr double near = 1e-2;  // of the scale of guards
  std::vector<Landing> bounds;
  for (auto j = static_cast<Index>(at.state.active_set.size()); j < at.guards.size(); ++j)
    if (at.guards[j] > 0.0 && at.guards[j] < near && at.guard_rates[j] < 0.0)
      bounds.push_back({.guard = j, .slack = at.guards[j]});
  const auto way = [&](const Landing& bound) { return -at.guards[bound.guard] / at.guard_rates[bound.guard]; };
  std::sort(bounds.begin(), bounds.end(), [&](const Landing& a, const Landing& b) { return way(a) < way(b); });
  return bounds;
}

// Where no step succeeds, as before the end of a stretch whose forces are lost in round-off, a bound that is near is
// passed early: what lies behind it holds on its own. Empty where nothing does, or is far off.
std::optional<Accepted> pass_near_bound(TraceTools& tools, const TracerState& state) {
  constexpr double far = 0.02;                           // of the greatest λ so far
  if (tools.system.has_friction()) return std::nullopt;  // its bounds hold
  if (!state.from.before) return std::nullopt;           // contacts have changed just before: what is near lies behind
  const double lambda = state.from.point.state.lambda;
  const auto turns = [](const Event& event) { return event.kind == EventKind::contact_limit_point; };
  for (const Landing& bound : near_bounds(state.from.point)) {
    TracerState early = state;
    early.from.passed_bound = bound;
    ArcAttempt attempt = attempt_arc(tools, early, state.step.length());
    auto* const accepted = std::get_if<Accepted>(&attempt.result);
    if (accepted == nullptr || accepted->end) continue;
    const auto& events = accepted->arc.events;
    if (std::abs(accepted->arc.to.state.lambda - lambda) > far * state.greatest_lambda) continue;
    if (std::any_of(events.begin(), events.end(), turns)) continue;
    attempt.ledger.strategies.push_back(Strategy::near_guard);
    tell_ledger(tools.options, attempt);
    return std::move(*accepted);
  }
  return std::nullopt;
}

// Where no step succeeds behind a span that has just begun: a longer one may, with patience. Round-off hides the less
// of the span the longer that has become.
std::optional<Accepted> step_patiently(TraceTools& tools, const TracerState& state, double longest) {
  constexpr int tried = 6;
  double s = longest;
  for (int i = 0; i < tried; ++i, s *= 0.5) {
    tools.corrector.track_from(state.from.nearest());
    tools.counter.track_from(state.from.nearest());
    ArcAttempt attempt = attempt_arc(tools, state, s, Effort::patient);
    auto* const accepted = std::get_if<Accepted>(&attempt.result);
    if (accepted == nullptr) continue;
    attempt.ledger.strategies.push_back(Strategy::longer_step);
    tell_ledger(tools.options, attempt);
    return std::move(*accepted);
  }
  return std::nullopt;
}

// The length of the next step, as the tangent where it begins allows it.
void limit_step(const TraceTools& tools, TracerState& state) {
  const PathPoint& from = state.from.point;
  const Metric metric = tools.metric_on(from.state.active_set, state.lambda_scale);
  state.step.limit(std::sqrt(metric.inner_x(from.tangent, from.tangent)), from.tangent.dlambda);
}

// Goes on from an accepted arc, which is given.
Arc take(Accepted accepted, TracerState& state) {
  if (const auto& progress = accepted.progress)
    state.step.succeeded(progress->iterations, progress->turn, progress->taken);
  ++state.points;
  state.greatest_lambda = std::max(state.greatest_lambda, std::abs(accepted.arc.to.state.lambda));
  state.from = std::move(accepted.leave);
  if (accepted.visit) remember(state.visited, std::move(*accepted.visit));
  state.corners_without_progress = accepted.corners_without_progress;
  state.end = std::move(accepted.end);
  return std::move(accepted.arc);
}

}  // namespace

Tracer::Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched)
    : tools_(std::make_unique<TraceTools>(system, std::move(options))), watched_(std::move(watched)) {
  std::optional<double> scale = start.lambda_scale ? start.lambda_scale : tools_->options.lambda_scale;
  if (!scale) scale = natural_lambda_scale(*tools_, start.state);
  state_.lambda_scale = scale.value_or(std::abs(tools_->options.step.first));
  state_.lambda_scale_is_assumed = !scale;
  state_.step = StepControl(tools_->options.step, tools_->options.step.max);
  state_.from.point.state = start.state;
  state_.start = std::move(start);
  set_detectors();
}

Tracer::~Tracer() = default;

void Tracer::set_detectors() {
  const std::vector<EventDetector> slip_ends = slip_end_detectors(tools_->system);
  auto& detectors = tools_->detectors;
  detectors.clear();
  if (tools_->options.events == EventSearch::none) {
    detectors = slip_ends;
    return;
  }
  const Metric metric = tools_->metric_on(state_.from.point.state.active_set, state_.lambda_scale);
  detectors.push_back(limit_point_detector(metric));
  detectors.insert(detectors.end(), slip_ends.begin(), slip_ends.end());
  for (const Watch& watch : watched_) detectors.push_back(turning_detector(tools_->system, metric, watch));
  const auto& own = tools_->options.detectors;
  detectors.insert(detectors.end(), own.begin(), own.end());
}

// What was assumed where λ does not move the structure, as a load that presses on a contact, is measured as soon as it
// does; not where a span has just begun that is too stiff to say much.
void Tracer::measure_lambda_scale() {
  Departure& from = state_.from;
  if (!state_.lambda_scale_is_assumed || from.known_end) return;
  const std::optional<double> scale = natural_lambda_scale(*tools_, from.point.state);
  if (!scale) return;
  state_.lambda_scale = *scale;
  state_.lambda_scale_is_assumed = false;
  set_detectors();
  from.point.tangent = unit(tools_->metric_on(from.point.state.active_set, *scale), from.point.tangent);
  state_.step.restart(std::abs(tools_->options.step.first / from.point.tangent.dlambda));
}

std::optional<Arc> Tracer::next() {
  if (state_.end) return std::nullopt;
  if (state_.points == 0) {
    std::optional<Arc> first = begin();
    if (first) measure_lambda_scale();
    return first;
  }
  if (state_.points >= tools_->options.max_points) {
    state_.end = {.reason = EndReason::max_points, .detail = std::to_string(state_.points) + " points"};
    return std::nullopt;
  }
  std::optional<Rejected> why;
  int insertions = 0;
  limit_step(*tools_, state_);
  const double longest = state_.step.length();
  while (!state_.step.too_short()) {
    const double s = state_.step.length();
    // What is followed begins where the point says, so that the path does not depend on what was tried before.
    tools_->corrector.track_from(state_.from.nearest());
    tools_->counter.track_from(state_.from.nearest());
    ArcAttempt attempt = attempt_arc(*tools_, state_, s);
    tell_ledger(tools_->options, attempt);
    if (auto* const accepted = std::get_if<Accepted>(&attempt.result)) {
      Arc arc = take(std::move(*accepted), state_);
      measure_lambda_scale();
      return arc;
    }
    state_.from.pending_singular.clear();  // where what was known could not be reached, a step is taken anew
    state_.from.known_end.reset();
    auto* const retry = std::get_if<Retry>(&attempt.result);
    if (retry && ++insertions <= most_insertions) {
      state_.from = std::move(retry->finer);
      continue;
    }
    why = telling(why, retry ? Rejected{.outcome = StepOutcome::penetration} : std::get<Rejected>(attempt.result));
    state_.step.failed(s);
  }
  BranchEnd end = end_of_attempts(tools_->options, why);
  if (end.reason == EndReason::min_step) {
    if (auto patient = step_patiently(*tools_, state_, longest)) {
      state_.step.restart(longest);
      return take(std::move(*patient), state_);
    }
    if (auto early = pass_near_bound(*tools_, state_)) {
      state_.step.restart(tools_->options.step.max);
      return take(std::move(*early), state_);
    }
  }
  state_.end = std::move(end);
  return std::nullopt;
}

std::optional<Arc> Tracer::begin() {
  const ActiveSet start = state_.start.state.active_set;
  BranchBegun begun = begin_branch(*tools_, state_);
  state_.end = begun.end;
  if (begun.end) return std::nullopt;
  state_.start.state = begun.from.point.state;
  state_.from = std::move(begun.from);
  state_.step.restart(begun.step_length);
  if (begun.visit) remember(state_.visited, std::move(*begun.visit));
  const bool contacts_change = begun.arc.events.size() > 1;
  if (contacts_change) state_.end = stop_at_contacts(tools_->options, start, begun.arc.to.state.active_set);
  if (!state_.end) state_.end = stop_at_events(tools_->options, begun.arc.events);
  state_.points = 1;
  state_.greatest_lambda = std::abs(begun.arc.to.state.lambda);
  return std::move(begun.arc);
}

bool Tracer::is_of_this_branch(const TracerState& state) const {
  const auto is_known = [&](const SingularPoint& singular) {
    const EventPlace& place = singular.place;
    switch (place.what) {
      case EventPlace::What::branch_point:
        return true;
      case EventPlace::What::detector:
        return place.which < tools_->detectors.size();
      case EventPlace::What::target_value:
        return place.which < tools_->options.target_values.size();
    }
    return false;
  };
  const Departure& from = state.from;
  return from.signs.size() == (state.points == 0 ? 0 : tools_->detectors.size()) &&
         std::all_of(from.pending_singular.begin(), from.pending_singular.end(), is_known) &&
         std::all_of(from.values_ahead.begin(), from.values_ahead.end(),
                     [&](const ValuePoint& value) { return value.which < tools_->options.target_values.size(); });
}

}  // namespace arcwall
