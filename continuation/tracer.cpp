#include "continuation/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr int max_landings = 100;     // guards that turn out to come before the one landed on
constexpr double together = 1e3;      // guard tolerances within which guards that are landed on in turn are one corner
constexpr double near_corner = 1e-4;  // gaps between contacts that are let pass before a corner is left
constexpr double passing = 1e-5;      // of points on a path near which it is singular [path metric]

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

double angle_between(const Metric& metric, const Direction& a, const Direction& b) {
  const double cosine = metric.inner(a, b) / (metric.norm(a) * metric.norm(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// λ₀ of the metric: the load that would move the structure by 1 if it stayed linear.
double natural_lambda_scale(const System& system, Corrector& corrector, const State& start, double first) {
  const Metric metric(system.weights(start.piece), 1.0);
  const Direction up{.dx = Vector::Zero(start.x.size()), .dlambda = 1.0};
  const CorrectorResult at = corrector.inspect(start, metric, up);
  corrector.track_from({});
  if (!at.converged()) return std::abs(first);
  const double scale = std::abs(at.tangent.dlambda) / std::sqrt(metric.inner_x(at.tangent, at.tangent));
  return std::isfinite(scale) && scale > 0.0 ? scale : std::abs(first);
}

}  // namespace

Tracer::Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched)
    : system_(system),
      options_(std::move(options)),
      watched_(std::move(watched)),
      corrector_(system, options_.corrector, std::abs(options_.step.first)),
      metric_(system.weights(start.state.piece),
              start.lambda_scale ? *start.lambda_scale
                                 : natural_lambda_scale(system, corrector_, start.state, options_.step.first)),
      counter_(system, corrector_.factorized(), options_.guard_tolerance),
      step_(options_.step, options_.step.max),
      start_(std::move(start)) {
  here_.state = start_.state;
  if (options_.events == EventSearch::none) return;
  detectors_.push_back(limit_point_detector(metric_));
  for (const Watch& watch : watched_)
    detectors_.push_back(turning_detector(system_, metric_, watch.quantity, watch.label));
  detectors_.insert(detectors_.end(), options_.detectors.begin(), options_.detectors.end());
}

std::optional<Arc> Tracer::next() {
  if (ahead_) return std::exchange(ahead_, std::nullopt);
  if (end_) return std::nullopt;
  if (points_ == 0) return start_.forward ? begin_at_branch_point() : begin();
  if (points_ >= options_.max_points) {
    end_ = {.reason = EndReason::max_points, .detail = std::to_string(points_) + " points"};
    return std::nullopt;
  }
  while (!step_.too_short()) {
    const double s = step_.length();
    // What is followed begins where the point says, so that the path does not depend on what was tried before.
    corrector_.track_from(nearest());
    counter_.track_from(nearest());
    attempt_ = {.arc = here_.arc, .radius = s};
    auto arc = advance(s);
    tell_ledger(arc);
    if (arc) return arc;
    if (end_) return std::nullopt;
    if (!std::exchange(refined_, false)) step_.failed(s);
  }
  give_up();
  return std::nullopt;
}

// The start: its forward tangent, and the contacts that already touch.
std::optional<Arc> Tracer::begin() {
  const Direction forward{.dx = Vector::Zero(here_.state.x.size()), .dlambda = options_.step.first > 0.0 ? 1.0 : -1.0};
  const ParameterValue parameter;
  const ValueConstraint hold(parameter, here_.state.lambda);
  CorrectorResult start = corrector_.correct(here_.state, hold, metric_, forward, 1e-6);
  if (!start.converged()) start = corrector_.inspect(here_.state, metric_, forward);
  if (!start.converged()) {
    const bool finite = start.status != CorrectorStatus::not_finite;
    end_ = {.reason = finite ? EndReason::singular : EndReason::not_finite, .detail = "at the start"};
    return std::nullopt;
  }
  here_ = point_of(std::move(start), forward);
  decide_count(here_);
  Arc arc;
  if (system_.guard_count(here_.state.piece) > 0 &&
      !degenerate_contacts(here_.guards, here_.state.piece, options_.guard_tolerance).empty()) {
    if (!turn_corner(here_, -1, 0.0, arc.events)) return std::nullopt;
  }
  here_.count = counter_.count(here_.state, here_.held);
  signs_ = signs_at(here_);
  step_.restart(std::abs(options_.step.first / here_.tangent.dlambda));
  start_.state = here_.state;
  held_ = here_.held;
  after_ = here_.count;
  ++points_;
  arc.to = here_;
  arc.events.insert(arc.events.begin(), Event{.kind = EventKind::start,
                                              .state = here_.state,
                                              .residual = here_.residual,
                                              .unstable_before = here_.count.unstable,
                                              .unstable_after = here_.count.unstable});
  return arc;
}

// At a branch point K is singular: signs and counts are taken up behind the first step.
std::optional<Arc> Tracer::begin_at_branch_point() {
  CorrectorResult start = corrector_.inspect(here_.state, metric_, *start_.forward);
  start.state = here_.state;
  start.tangent = *start_.forward;
  here_ = point_of(std::move(start), *start_.forward);
  here_.held = std::nullopt;
  here_.count = {.unstable = start_.unstable, .stability = Stability::undecided};
  signs_ = signs_at(here_);
  step_.restart(start_.distance);
  ++points_;
  Arc arc{.to = here_};
  arc.events.push_back({.kind = EventKind::start,
                        .state = here_.state,
                        .residual = here_.residual,
                        .unstable_before = start_.unstable,
                        .unstable_after = start_.unstable});
  return arc;
}

// One arc: predict and correct, land on the first change of contact, then on the first event before it; leave the
// corner.
std::optional<Arc> Tracer::advance(double s) {
  std::vector<Singular> singular = std::exchange(near_, {});
  auto step = singular.empty() ? take_clear_of_singular(s) : std::optional(Step{.to = singular.front().at});
  if (!step) return std::nullopt;
  if (step->continuum) step->to.held = std::nullopt;
  if (singular.empty() && options_.events != EventSearch::none && !find_singular(step->to, singular))
    return rejected(StepOutcome::events_unclear);

  std::optional<Found> found;
  PathPoint beyond;  // where the step led that ends at an event
  const auto end_at = [&](const Found& event, PathPoint at) {
    if (!found) beyond = std::move(step->to);
    found = event;
    step->to = std::move(at);
    step->corner = false;
  };
  if (!singular.empty()) end_at(singular.front().found, singular.front().at);
  const bool looks = options_.events != EventSearch::none || !options_.target_values.empty();
  double length = 0.0;
  for (;;) {
    constexpr double same = 1e-9;  // what was located lies at the end itself
    const Segment segment(metric_, here_, step->to);
    length = segment.length();
    auto next = looks ? earliest(segment, found) : std::nullopt;
    if (!next || (found && next->t >= 1.0 - same)) break;
    auto at = locate(*next, step->to);
    if (!at) return rejected(StepOutcome::events_unclear);
    singular.clear();
    end_at(*next, std::move(*at));
  }
  PathPoint to = std::move(step->to);
  to.arc = here_.arc + length;
  if (!singular.empty())
    to.count = {};  // an eigenvalue is zero there
  else
    to.count = step->continuum ? StabilityCount{.unstable = after_.unstable} : counter_.count(to.state, to.held);

  // A pitchfork met along its own branch, where λ turns and an eigenvalue touches zero, was reported on the other.
  const bool crosses = !singular.empty() && singular.front().branching && singular.front().change % 2 == 0;
  if (crosses && (end_ = end_where_known(to, &to.state))) {
    singular.clear();
    found.reset();
  }

  Arc arc;
  StabilityCount behind = to.count;  // just after `to`
  if (!singular.empty()) {
    const Singular& first = singular.front();
    behind = count_behind(beyond, first.change);
    arc.events = events_of(first, to, beyond, behind, length);
    near_.assign(std::next(singular.begin()), singular.end());
    held_ = *held_ + first.change;
    vanishing_ = first.branching ? first.branching->multiplicity : 1;
  } else {
    if (found && found->what != Found::What::target_value)
      arc.events.push_back(event_of(*found, to, beyond, behind, length));
    if (to.held || step->continuum) held_ = to.held;
    vanishing_ = to.held ? 0 : 1;
  }
  if (found && found->what == Found::What::target_value) stop_at(options_.target_values[found->which], to);
  if (!step->corner) after_ = behind;
  if (!step->corner && !end_) end_ = end_where_known(to);
  step_.succeeded(to.iterations, step->turn, step->corner || found ? length : s);

  const bool touched = !singular.empty() && singular.front().suspected && !singular.front().branching;
  std::vector<int> signs = signs_at(to);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] == 0) signs[i] = signs_[i];
    if (found && found->what == Found::What::detector && found->which == i && !touched) signs[i] = -signs_[i];
  }
  signs_ = signs;
  if (step->corner && !end_) {
    standing_ = length <= options_.guard_tolerance ? standing_ + 1 : 0;
    const PathPoint before = to;
    const bool limit = step->guard >= static_cast<Index>(to.state.piece.size());
    if (limit ? pass_limit(to, step->guard, step->slack, arc.events)
              : turn_corner(to, step->guard, step->slack, arc.events)) {
      const std::vector<int> turned = signs_at(to);
      for (std::size_t i = 0; i < turned.size(); ++i)
        if (turned[i] != 0) signs_[i] = turned[i];
      held_ = to.held;
      after_ = to.count;
    } else if (ahead_) {
      signs_ = signs_at(ahead_->to);
    }
    const Index closed = to.state.piece.closed_count();
    if (!end_ && options_.stop_contacts && closed >= *options_.stop_contacts)
      end_ = {.reason = EndReason::stop, .detail = "contacts = " + std::to_string(closed)};
  }
  if (!end_) stop_at(arc.events);
  before_.reset();
  const bool smooth = !step->corner && !ahead_ && length > 0.0;
  PathPoint from = go_to(ahead_ ? ahead_->to : to);
  if (smooth) {
    values_before_ = values_of_modes(here_, from);
    from.nearest = {};
    before_ = std::move(from);
  }
  points_ += ahead_ ? 2 : 1;
  arc.to = std::move(to);
  return arc;
}

// A target_value was landed on: the branch ends if it, or another of the same quantity and value, is a bound.
void Tracer::stop_at(const TargetValue& landed, const PathPoint& to) {
  for (const TargetValue& mark : options_.target_values)
    if (mark.stops && mark.value == landed.value && mark.quantity->value(to.state) == landed.quantity->value(to.state))
      end_ = {.reason = EndReason::stop, .detail = mark.label};
}

void Tracer::stop_at(const std::vector<Event>& events) {
  for (const StopEvent& stop : options_.stop_events)
    if (std::any_of(events.begin(), events.end(), [&](const Event& event) { return event.kind == stop.kind; }))
      end_ = {.reason = EndReason::stop, .detail = stop.label};
}

// A step that ends on a singular point shows nothing of it, and its tangent there may be any: a shorter one is taken.
std::optional<Tracer::Step> Tracer::take_clear_of_singular(double s) {
  constexpr double beside_singular = 0.93;
  auto step = take(s);
  if (!step || step->corner || step->to.held || !held_ || options_.events != EventSearch::locate) return step;
  corrector_.track_from(nearest());
  auto shorter = take(beside_singular * s);
  return shorter && shorter->to.held ? shorter : step;
}

std::optional<Tracer::Step> Tracer::take(double s) {
  // Off a branch point the component along the mode is prescribed, so that the step cannot fall back.
  const bool leaves = points_ == 1 && start_.forward;
  const auto constraint =
      leaves ? std::make_unique<PlaneConstraint>(metric_, here_.state, start_.mode,
                                                 s * metric_.inner(here_.tangent, start_.mode))
             : step_constraint(options_.method, metric_, here_.state, here_.tangent, s, options_.control.get());
  CorrectorResult result = corrector_.correct(predicted(s), *constraint, metric_, here_.tangent, s);
  if (!result.converged() && before_)
    result = corrector_.correct(moved(here_.state, here_.tangent, s), *constraint, metric_, here_.tangent, s);
  last_failure_ = result.status;
  attempt_.iterations = result.iterations;
  attempt_.residual = result.residual;
  attempt_.roots = result.roots;
  if (!result.converged()) return rejected(outcome_of(result.status));
  invalid_reason_ = system_.invalid_reason(result.state);
  if (invalid_reason_) return rejected(StepOutcome::obstructed);

  Step step{.to = point_of(std::move(result), here_.tangent)};
  const bool trusted = trustworthy(step.to, s, step.turn);
  attempt_.turn = step.turn;
  if (!trusted) return rejected(step.turn > options_.step.max_turn ? StepOutcome::turned : StepOutcome::strayed);
  if (step.to.guards.size() > 0)
    if (const auto crossing = first_crossing(Segment(metric_, here_, step.to)); crossing && !land(step, *crossing))
      return rejected(StepOutcome::not_landed);
  // What vanishes with the guard that was landed on belongs to the corner.
  const double margin = step.corner ? near_corner : -penetration_tolerance;
  if (!system_.admissible(step.to.state, margin)) {
    refine(step.to.state, margin);
    if (refined_) return rejected(StepOutcome::refined);
    if (!step.corner || !system_.admissible(step.to.state, -penetration_tolerance))
      return rejected(StepOutcome::penetrates);
  }
  decide_count(step.to);
  return step;
}

// The guess for the end of a step: along the cubic through the last two points and their tangents, else along the
// tangent. What is controlled has its value where the tangent leads; where contacts are watched steps end at corners as
// often as not, and the tangent does not overshoot them.
State Tracer::predicted(double s) const {
  constexpr double reach = 2.5;  // of the last step, to which a cubic is extrapolated
  const bool controlled = options_.method == PathMethod::load || options_.method == PathMethod::displacement;
  const bool guarded = system_.guard_count(here_.state.piece) > 0;
  if (before_ && !controlled && !guarded && before_->state.piece == here_.state.piece) {
    const Segment last(metric_, *before_, here_);
    if (s <= reach * last.length()) return last.at(1.0 + s / last.length());
  }
  return moved(here_.state, here_.tangent, s);
}

// Whether the end of a step is the continuation of its start: neither far off the predictor nor turned too much.
bool Tracer::trustworthy(const PathPoint& to, double s, double& turn) const {
  const Direction chord = difference(to.state, here_.state);
  const double length = metric_.norm(chord);
  turn = angle_between(metric_, here_.tangent, to.tangent);
  return length <= 2.0 * s && turn <= options_.step.max_turn &&
         angle_between(metric_, here_.tangent, chord) <= options_.step.max_turn;
}

std::optional<Tracer::GuardCrossing> Tracer::first_crossing(const Segment& segment) const {
  const PathPoint &from = segment.from(), &to = segment.to();
  const double L = segment.length(), tolerance = options_.guard_tolerance;
  // Branch points are interpolated: guards that are zero there (a flat part buckles off its wall) are known no better.
  const double unsure = points_ == 1 && start_.forward ? passing : tolerance;
  std::optional<GuardCrossing> first;
  for (Index j = 0; j < to.guards.size(); ++j) {
    const double v0 = from.guards[j], r0 = from.guard_rates[j], v1 = to.guards[j], r1 = to.guard_rates[j];
    const bool touches = v0 <= tolerance && v0 >= -unsure;
    if (v1 >= -tolerance && least_cubic_value(touches ? 0.0 : v0, r0 * L, v1, r1 * L) >= -tolerance) continue;
    const double t = segment.first_zero(v0, r0, v1, r1, tolerance).value_or(0.0);
    if (!first || t < first->t) first = GuardCrossing{.guard = j, .t = t};
  }
  return first;
}

// Solves for the guard's zero, and for that of any guard that turns out to come before.
bool Tracer::land(Step& step, GuardCrossing crossing) {
  // Contacts that should vanish together miss each other by round-off, more so where a mode is almost neutral: then
  // none of the landings leaves all guards fulfilled to the last digit, and the best of them is the corner.
  std::optional<Step> nearly;
  for (int landing = 0; landing < max_landings; ++landing) {
    const Segment segment(metric_, here_, step.to);
    auto at = correct_onto(GuardConstraint(system_, crossing.guard), segment, crossing.t);
    if (!at || lands_where_it_began(*at, crossing.guard)) break;
    step.corner = true;
    step.guard = crossing.guard;
    step.to = std::move(*at);
    step.slack = std::max(0.0, -step.to.guards.minCoeff());
    step.continuum = leads_to_continuum(step);
    if (step.continuum && segment.length() > coincidence_tolerance) step.to.tangent = tangent_from(here_, step.to);
    if (step.slack <= options_.guard_tolerance || step.continuum) return true;
    if (step.slack <= together * options_.guard_tolerance && (!nearly || step.slack < nearly->slack)) nearly = step;
    const auto before = first_crossing(Segment(metric_, here_, step.to));
    if (!before || (nearly && landing >= 3)) break;
    crossing = *before;
  }
  if (nearly) step = std::move(*nearly);
  return step.corner && step.slack <= together * options_.guard_tolerance;
}

// At the end of a parabola that begins at a point with its tangent.
Direction Tracer::tangent_from(const PathPoint& from, const PathPoint& to) const {
  const Direction chord = difference(to.state, from.state);
  const double L = metric_.norm(chord);
  return unit(metric_,
              {.dx = 2.0 / L * chord.dx - from.tangent.dx, .dlambda = 2.0 / L * chord.dlambda - from.tangent.dlambda});
}

// A guard that has just left zero, and in a long step seems to come back: its zero that is found is the old one.
bool Tracer::lands_where_it_began(const PathPoint& at, Index guard) const {
  return here_.guards[guard] <= options_.guard_tolerance && here_.guard_rates[guard] > 0.0 &&
         metric_.distance(at.state, here_.state) <= coincidence_tolerance;
}

// Where a continuum of equilibria lies ahead, the equations are singular at the corner: guards that should vanish
// together miss each other by more than elsewhere, eigenvalues that should be zero have no sure sign, and the tangent
// is any.
bool Tracer::leads_to_continuum(const Step& step) const {
  constexpr double singular = 1e-6;  // in the scale of guards
  const PathPoint& at = step.to;
  if (step.guard < static_cast<Index>(at.state.piece.size()) || step.slack > singular) return false;
  const double tolerance = std::max(options_.guard_tolerance, 2.0 * step.slack);
  const auto ahead = system_.transitions(at.state, at.tangent, step.guard, tolerance);
  return !ahead.empty() && ahead.front().change == Transition::Change::continuum;
}

std::optional<PathPoint> Tracer::correct_onto(const PathConstraint& constraint, const Segment& segment, double t) {
  return correct_onto(constraint, segment, segment.at(t), segment.length() * std::min(t, 1.0 - t), Wanted::pairs);
}

// The same from a guess at a distance from points that are known.
std::optional<PathPoint> Tracer::correct_onto(const PathConstraint& constraint, const Segment& segment, State guess,
                                              double distance, Wanted wanted) {
  distance = std::max(distance, 1e-3 * segment.length());
  CorrectorResult result = corrector_.correct(std::move(guess), constraint, metric_, here_.tangent, distance, wanted);
  last_failure_ = result.status;
  if (!result.converged()) return std::nullopt;
  // The place must lie inside the step, up to the curvature of the arc.
  const double along = metric_.inner(difference(result.state, here_.state), segment.chord()) / segment.length();
  if (along < -1e-6 * segment.length() || along > 1.2 * segment.length()) return std::nullopt;
  return point_of(std::move(result), here_.tangent);
}

// The eigenpairs nearest zero and their count, of a point that was found without them.
void Tracer::find_pairs(PathPoint& at) {
  CorrectorResult seen = corrector_.find_pairs(at.state, metric_);
  at.nearest = std::move(seen.nearest);
  at.held = at.count.unstable = seen.negative;
}

PathPoint Tracer::point_of(CorrectorResult result, const Direction& forward) const {
  PathPoint point;
  point.tangent =
      metric_.inner(result.tangent, forward) >= 0.0 ? std::move(result.tangent) : reversed(std::move(result.tangent));
  point.state = std::move(result.state);
  point.held = point.count.unstable = result.negative;
  point.iterations = result.iterations;
  point.residual = result.residual;
  point.nearest = std::move(result.nearest);
  point.guards = system_.guards(point.state);
  point.guard_rates = system_.guard_rates(point.state, point.tangent);
  return point;
}

// Gives the point that is left; its eigenpairs stay known where the new one shows none.
PathPoint Tracer::go_to(PathPoint point) {
  PathPoint left = std::exchange(here_, std::move(point));
  if (here_.nearest.values.size() == 0 && left.nearest.values.size() > 0) nearest_ = left.nearest;
  return left;
}

// The count of negative eigenvalues where the pivots do not tell it.
void Tracer::decide_count(PathPoint& point) {
  if (point.held) return;
  if (corrector_.is_at(point.state)) counter_.remember(point.state, corrector_.count_here(point.state, point.nearest));
  point.held = point.count.unstable = counter_.negative_on(point.state);
}

// Whether the step passes a point: it lies beside the chord, and on the path as exactly as such points are located.
bool Tracer::passes(const PathPoint& to, const State& place) {
  if (place.piece != to.state.piece) return false;
  // What lies beside the chord has its λ there, too.
  const double lambda_off = std::abs(place.lambda - to.state.lambda) / metric_.lambda_scale();
  if (lambda_off > 1.1 * (to.arc - here_.arc) + passing) return false;
  const Segment segment(metric_, here_, to);
  const double L = segment.length();
  // A turning point at a pitchfork is located there, a little before or behind it.
  if (metric_.distance(to.state, place) <= std::min(passing, 0.25 * L)) return true;
  const Direction offset = difference(place, here_.state);
  const double t = metric_.inner(offset, segment.chord()) / (L * L);
  if (!(t > 0.0 && t <= 1.0 + coincidence_tolerance)) return false;
  const double beside = std::sqrt(std::max(0.0, metric_.inner(offset, offset) - t * t * L * L));
  if (beside > 0.25 * L) return false;
  const auto at = correct_onto(PlaneConstraint(metric_, place, segment.chord(), 0.0), segment, std::min(t, 1.0));
  return at && metric_.distance(at->state, place) <= passing;
}

// The end of a branch at a place that was passed before; `place`, if given, becomes that place.
std::optional<BranchEnd> Tracer::end_where_known(const PathPoint& to, State* place) {
  const bool far = to.arc > 3.0 * (to.arc - here_.arc) + coincidence_tolerance;
  if (!far) return std::nullopt;
  if (passes(to, start_.state)) {
    if (place) *place = start_.state;
    return BranchEnd{.reason = EndReason::closed_loop, .detail = "the branch came back to its start"};
  }
  for (const KnownPoint& known : start_.known)
    if (passes(to, known.state)) {
      if (place) *place = known.state;
      return BranchEnd{.reason = EndReason::joined,
                       .detail = "joins branch " + std::to_string(known.branch),
                       .partner = known.branch};
    }
  return std::nullopt;
}

std::nullopt_t Tracer::rejected(StepOutcome outcome) {
  attempt_.outcome = outcome;
  return std::nullopt;
}

void Tracer::tell_ledger(const std::optional<Arc>& arc) {
  if (!options_.ledger) return;
  if (arc) {
    attempt_.outcome = StepOutcome::accepted;
    attempt_.accepted = &*arc;
  } else if (end_) {
    attempt_.outcome = StepOutcome::ended;
  }
  options_.ledger(attempt_);
}

void Tracer::give_up() {
  const bool controlled = options_.method == PathMethod::load || options_.method == PathMethod::displacement;
  if (invalid_reason_) {
    end_ = {.reason = EndReason::wall_end, .detail = "a closed contact reached the end of its wall"};
  } else if (controlled) {
    end_ = {.reason = EndReason::turning_control,
            .detail = "the controlled quantity turns back; use method = \"spherical\" to go on"};
  } else if (attempt_.outcome == StepOutcome::penetrates) {
    end_ = {.reason = EndReason::unsupported, .detail = "a wall is touched ahead where contact cannot be followed"};
  } else if (last_failure_ == CorrectorStatus::singular) {
    end_ = {.reason = EndReason::singular, .detail = "the equations are singular ahead"};
  } else if (last_failure_ == CorrectorStatus::not_finite) {
    end_ = {.reason = EndReason::not_finite, .detail = "a step leads to numbers that are not finite"};
  } else {
    end_ = {.reason = EndReason::min_step, .detail = "no step above path.min_step succeeds"};
  }
}

}  // namespace arcwall
