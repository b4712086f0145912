#include "continuation/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "core/root_find.hpp"

namespace arcwall {

namespace {

constexpr int max_landings = 100;  // guards that turn out to come before the one landed on
constexpr double together = 1e3;   // guard tolerances within which guards that are landed on in turn are one corner
constexpr int max_standing = 50;
constexpr double same_place = 1e-8;      // in the path metric
constexpr double passing = 1e-5;         // likewise, of points on a path near which it is singular
constexpr double same_way = 1.0 - 1e-6;  // cosine above which two directions are one

int sign_of(double value) { return std::abs(value) <= detector_noise ? 0 : value > 0.0 ? 1 : -1; }

double angle_between(const Metric& metric, const Direction& a, const Direction& b) {
  const double cosine = metric.inner(a, b) / (metric.norm(a) * metric.norm(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// λ₀ of the metric: the load that would move the structure by 1 if it stayed linear.
double natural_lambda_scale(const System& system, const State& start, double first) {
  Metric metric(system.weights(start.piece), 1.0);
  Corrector corrector(system, {}, std::abs(first));
  const Direction up{.dx = Vector::Zero(start.x.size()), .dlambda = 1.0};
  const CorrectorResult at = corrector.inspect(start, metric, up);
  if (!at.converged()) return std::abs(first);
  const double scale = std::abs(at.tangent.dlambda) / std::sqrt(metric.inner_x(at.tangent, at.tangent));
  return std::isfinite(scale) && scale > 0.0 ? scale : std::abs(first);
}

}  // namespace

EventDetector limit_point_detector(const Metric& metric) {
  const double scale = metric.lambda_scale();
  return {.kind = EventKind::limit_point,
          .label = "lambda",
          .value = [scale](const PathPoint& point) { return point.tangent.dlambda / scale; },
          .integral = [scale](const PathPoint& point) { return point.state.lambda / scale; }};
}

EventDetector turning_detector(const System& system, const Metric& metric, std::shared_ptr<const Observable> quantity,
                               std::string label) {
  const double lambda_scale = metric.lambda_scale();
  const auto rate = [&system, lambda_scale, quantity](const PathPoint& point) {
    const Row row = quantity->gradient(point.state);
    const double norm = Metric(system.weights(point.state.piece), lambda_scale).dual_norm(row);
    return norm > 0.0 ? apply(row, point.tangent) / norm : 0.0;
  };
  return {.kind = EventKind::displacement_limit, .label = std::move(label), .value = rate, .integral = nullptr};
}

Tracer::Tracer(const System& system, BranchStart start, TraceOptions options, std::vector<Watch> watched)
    : system_(system),
      options_(std::move(options)),
      watched_(std::move(watched)),
      metric_(system.weights(start.state.piece), start.lambda_scale
                                                     ? *start.lambda_scale
                                                     : natural_lambda_scale(system, start.state, options_.step.first)),
      corrector_(system, options_.corrector, std::abs(options_.step.first)),
      counter_(system, options_.guard_tolerance),
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
  if (end_) return std::nullopt;
  if (points_ == 0) return start_.forward ? begin_at_branch_point() : begin();
  if (points_ >= options_.max_points) {
    end_ = {.reason = EndReason::max_points, .detail = std::to_string(points_) + " points"};
    return std::nullopt;
  }
  while (!step_.too_short()) {
    const double s = step_.length();
    if (auto arc = advance(s)) return arc;
    if (end_) return std::nullopt;
    step_.failed(s);
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
  Arc arc;
  if (system_.guard_count() > 0 && !system_.weak_guards(here_.state, options_.guard_tolerance).empty()) {
    if (!turn_corner(here_, -1, 0.0, arc.events)) return std::nullopt;
  }
  here_.count = counter_.count(here_.state, std::nullopt);
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
  auto step = take(s);
  if (!step) return std::nullopt;
  const PathPoint beyond = step->to;
  const Segment whole(metric_, here_, beyond);
  if (options_.events != EventSearch::none && (hides_two_zeros(whole) || several_singular_points(whole)))
    return std::nullopt;

  std::optional<Found> found;
  if (options_.events != EventSearch::none || !options_.landmarks.empty()) {
    while (auto next = earliest(Segment(metric_, here_, step->to), found)) {
      auto at = locate(*next, step->to);
      if (!at) return std::nullopt;
      step->to = std::move(*at);
      step->corner = false;
      found = next;
    }
  }
  const double length = Segment(metric_, here_, step->to).length();
  PathPoint to = std::move(step->to);
  to.arc = here_.arc + length;
  const std::optional<Index> held = step->corner || found ? std::nullopt : to.count.unstable;
  to.count = counter_.count(to.state, held);

  Arc arc;
  if (found) {
    PathPoint after = beyond;
    after.count = counter_.count(after.state, std::nullopt);
    if (found->what != Found::What::landmark) arc.events.push_back(event_of(*found, to, after, length));
    if (found->what == Found::What::landmark && options_.landmarks[found->which].stops)
      end_ = {.reason = EndReason::stop, .detail = options_.landmarks[found->which].label};
  }
  const bool singular =
      found && (found->what == Found::What::branch_point ||
                (found->what == Found::What::detector && detectors_[found->which].kind == EventKind::limit_point));
  held_ = singular ? beyond.held : to.held;
  if (!step->corner) after_ = singular ? counter_.count(beyond.state, beyond.held) : to.count;
  if (!step->corner && !end_) end_where_known(to);
  step_.succeeded(to.iterations, step->turn, step->corner || found ? length : s);

  std::vector<int> signs = signs_at(to);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] == 0) signs[i] = signs_[i];
    if (found && found->what == Found::What::detector && found->which == i) signs[i] = -signs_[i];
  }
  signs_ = signs;
  if (step->corner && !end_) {
    standing_ = length <= options_.guard_tolerance ? standing_ + 1 : 0;
    const PathPoint before = to;
    if (turn_corner(to, step->guard, step->slack, arc.events)) {
      const std::vector<int> turned = signs_at(to);
      for (std::size_t i = 0; i < turned.size(); ++i)
        if (turned[i] != 0) signs_[i] = turned[i];
      held_ = to.held;
      after_ = to.count;
    }
    const Index closed = std::count(to.state.piece.begin(), to.state.piece.end(), std::uint8_t{1});
    if (!end_ && options_.stop_contacts && closed >= *options_.stop_contacts)
      end_ = {.reason = EndReason::stop, .detail = "contacts = " + std::to_string(closed)};
  }
  here_ = std::move(to);
  ++points_;
  arc.to = here_;
  return arc;
}

std::optional<Tracer::Step> Tracer::take(double s) {
  // Off a branch point the component along the mode is prescribed, so that the step cannot fall back.
  const bool leaves = points_ == 1 && start_.forward;
  const auto constraint =
      leaves ? std::make_unique<PlaneConstraint>(metric_, here_.state, start_.mode,
                                                 s * metric_.inner(here_.tangent, start_.mode))
             : step_constraint(options_.method, metric_, here_.state, here_.tangent, s, options_.control.get());
  CorrectorResult result =
      corrector_.correct(moved(here_.state, here_.tangent, s), *constraint, metric_, here_.tangent, s);
  last_failure_ = result.status;
  if (!result.converged()) return std::nullopt;
  obstruction_ = system_.obstruction(result.state);
  if (obstruction_) return std::nullopt;

  Step step{.to = point_of(std::move(result), here_.tangent)};
  if (!trustworthy(step.to, s, step.turn)) return std::nullopt;
  if (system_.guard_count() == 0) return step;
  if (const auto crossing = first_crossing(Segment(metric_, here_, step.to)))
    if (!land(step, *crossing)) return std::nullopt;
  return step;
}

// Whether the end of a step is the continuation of its start: neither far off the predictor nor turned too much.
bool Tracer::trustworthy(const PathPoint& to, double s, double& turn) const {
  const Direction chord = difference(to.state, here_.state);
  const double length = metric_.norm(chord);
  turn = angle_between(metric_, here_.tangent, to.tangent);
  return length <= 2.0 * s && turn <= options_.step.max_turn &&
         angle_between(metric_, here_.tangent, chord) <= options_.step.max_turn;
}

// λ may turn twice inside a step and look as if it had not: then the cubic through its ends does.
bool Tracer::hides_two_zeros(const Segment& segment) const {
  for (const EventDetector& detector : detectors_) {
    if (!detector.integral) continue;
    const double v0 = detector.integral(segment.from()), v1 = detector.integral(segment.to());
    const double r0 = detector.value(segment.from()), r1 = detector.value(segment.to());
    if (sign_of(r0) == 0 || sign_of(r0) != sign_of(r1)) continue;
    const double sign = r0 > 0.0 ? 1.0 : -1.0, L = segment.length();
    // The steepest fall of the cubic against the sign of both ends: v′ is a parabola with end values r0, r1 and mean
    // (v1 − v0)/L, so its least value inside is below both when the mean is small enough.
    const double mean = sign * (v1 - v0) / L, a = sign * r0, b = sign * r1;
    const double curvature = 3.0 * (a + b - 2.0 * mean), slope = 2.0 * (3.0 * mean - 2.0 * a - b);
    if (curvature <= 0.0) continue;
    const double t = -slope / (2.0 * curvature);
    if (t > 0.0 && t < 1.0 && a + t * (slope + t * curvature) < -detector_noise) return true;
  }
  return false;
}

std::optional<Tracer::GuardCrossing> Tracer::first_crossing(const Segment& segment) const {
  const PathPoint &from = segment.from(), &to = segment.to();
  const double L = segment.length(), tolerance = options_.guard_tolerance;
  std::optional<GuardCrossing> first;
  for (Index j = 0; j < to.guards.size(); ++j) {
    const double v0 = from.guards[j], r0 = from.guard_rates[j], v1 = to.guards[j], r1 = to.guard_rates[j];
    const bool touches = std::abs(v0) <= tolerance;
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
    if (!at) break;
    step.corner = true;
    step.guard = crossing.guard;
    step.to = std::move(*at);
    step.slack = std::max(0.0, -step.to.guards.minCoeff());
    if (step.slack <= options_.guard_tolerance) return true;
    if (step.slack <= together * options_.guard_tolerance && (!nearly || step.slack < nearly->slack)) nearly = step;
    const auto before = first_crossing(Segment(metric_, here_, step.to));
    if (!before || (nearly && landing >= 3)) break;
    crossing = *before;
  }
  if (nearly) step = std::move(*nearly);
  return step.corner && step.slack <= together * options_.guard_tolerance;
}

std::optional<PathPoint> Tracer::correct_onto(const PathConstraint& constraint, const Segment& segment, double t) {
  const double distance = std::max(segment.length() * std::min(t, 1.0 - t), 1e-3 * segment.length());
  CorrectorResult result = corrector_.correct(segment.at(t), constraint, metric_, here_.tangent, distance);
  last_failure_ = result.status;
  if (!result.converged()) return std::nullopt;
  // The place must lie inside the step, up to the curvature of the arc.
  const double along = metric_.inner(difference(result.state, here_.state), segment.chord()) / segment.length();
  if (along < -1e-6 * segment.length() || along > 1.2 * segment.length()) return std::nullopt;
  return point_of(std::move(result), here_.tangent);
}

// The first detector or landmark with a zero inside the segment, besides the one that its end lies on.
std::optional<Tracer::Found> Tracer::earliest(const Segment& segment, const std::optional<Found>& already) const {
  std::optional<Found> first;
  const bool turns =
      !signs_.empty() && signs_.front() * sign_of(segment.to().tangent.dlambda / metric_.lambda_scale()) < 0;
  const bool whole = !already;  // counts are certain at the end of a step, not at a located point
  if (options_.events == EventSearch::locate && whole && !turns && held_ && segment.to().held &&
      *held_ != *segment.to().held)
    return Found{.what = Found::What::branch_point, .which = 0, .t = 0.5, .half_width = 0.0};
  const auto consider = [&](Found::What what, std::size_t which, double t) {
    const bool done = already && already->what == what && already->which == which;
    if (!done && (!first || t < first->t)) first = Found{.what = what, .which = which, .t = t, .half_width = 0.0};
  };
  for (std::size_t i = 0; i < detectors_.size(); ++i) {
    const double v0 = detectors_[i].value(segment.from()), v1 = detectors_[i].value(segment.to());
    const int sign = sign_of(v1);
    if (signs_[i] * sign >= 0) continue;
    if (detectors_[i].crossing != Crossing::any && (sign > 0) != (detectors_[i].crossing == Crossing::rising)) continue;
    consider(Found::What::detector, i, signs_[i] * v0 > 0.0 ? v0 / (v0 - v1) : 0.0);
  }
  for (std::size_t i = 0; i < options_.landmarks.size(); ++i) {
    const Landmark& mark = options_.landmarks[i];
    const auto value = [&](const PathPoint& p) { return mark.quantity->value(p.state) - mark.value; };
    const auto rate = [&](const PathPoint& p) { return apply(mark.quantity->gradient(p.state), p.tangent); };
    const double v0 = value(segment.from()), v1 = value(segment.to());
    const double noise = 1e-11 * std::max({std::abs(mark.value), std::abs(v0), std::abs(v1)});
    if (const auto t = segment.first_zero(v0, rate(segment.from()), v1, rate(segment.to()), noise))
      consider(Found::What::landmark, i, *t);
  }
  return first;
}

// Lands on a landmark with its value as the constraint; brackets a detector's zero in planes across the chord.
std::optional<PathPoint> Tracer::locate(Found& found, const PathPoint& to) {
  if (found.what == Found::What::branch_point) return locate_branch_point(to);
  const Segment segment(metric_, here_, to);
  if (found.what == Found::What::landmark) {
    const Landmark& mark = options_.landmarks[found.which];
    return correct_onto(ValueConstraint(*mark.quantity, mark.value), segment, found.t);
  }
  if (options_.events == EventSearch::detect) {
    found.half_width = 0.5;
    found.t = 1.0;
    return to;
  }
  const EventDetector& detector = detectors_[found.which];
  const auto at = [&](double t) {
    Direction normal = segment.chord();
    const PlaneConstraint plane(metric_, here_.state, normal, t * segment.length() * segment.length());
    return correct_onto(plane, segment, t);
  };
  const auto value = [&](double t) -> std::optional<double> {
    const auto point = at(t);
    return point ? std::optional(detector.value(*point)) : std::nullopt;
  };
  const double sign = signs_[found.which];
  const double v0 = detector.value(here_);
  const double start = sign * v0 > 0.0 ? v0 : sign * detector_noise;
  const auto root = bracketed_root(value, 0.0, start, 1.0, detector.value(to), options_.localisation);
  if (!root) return std::nullopt;
  found.t = root->at;
  found.half_width = root->half_width;
  return at(root->at);
}

std::optional<PathPoint> Tracer::locate_branch_point(const PathPoint& to) {
  const Segment segment(metric_, here_, to);
  auto branching = std::make_shared<BranchPoint>();
  BranchPointLocator locator(system_, corrector_);
  const auto at = locator.locate(segment, metric_, held_.value(), to.held.value(), *branching);
  if (!at) return std::nullopt;
  CorrectorResult result = corrector_.inspect(at->state, metric_, at->tangent);
  result.state = at->state;
  result.tangent = at->tangent;
  result.iterations = at->iterations;
  branching->discretisation = options_.tied_contacts && system_.multiplier_count(to.state.piece) > 0;
  located_ = std::move(branching);
  return point_of(std::move(result), here_.tangent);
}

// A fold changes the count of negative eigenvalues by one, and so does a simple branch point. Where a step shows more,
// or a fold without its change, it is looked at again in shorter steps.
bool Tracer::several_singular_points(const Segment& segment) const {
  constexpr double inseparable = 1e-5;  // arc length below which they are one
  if (!held_ || !segment.to().held || segment.length() < inseparable || detectors_.empty()) return false;
  const Index changes = std::abs(*segment.to().held - *held_);
  const bool turns = signs_.front() * sign_of(detectors_.front().value(segment.to())) < 0;
  return changes > 1 || (turns && changes != 1);
}

Event Tracer::event_of(const Found& found, const PathPoint& at, const PathPoint& beyond, double length) const {
  if (found.what == Found::What::branch_point)
    return {.kind = EventKind::branch_point,
            .state = at.state,
            .arc = at.arc,
            .residual = at.residual,
            .localised =
                std::max(located_->localised, 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda)),
            .unstable_before = after_.unstable,
            .unstable_after = beyond.count.unstable,
            .branching = located_};
  const EventDetector& detector = detectors_[found.which];
  // λ changes by λ′ δ + ½ λ″ δ² over the bracket that is left.
  const double width = found.half_width * length / std::max(found.t, 1e-3);
  const double roundoff = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda);
  const double bend = std::abs(beyond.tangent.dlambda - here_.tangent.dlambda) / std::max(length, 1e-300);
  return {.kind = detector.kind,
          .label = detector.label,
          .state = at.state,
          .arc = at.arc,
          .residual = at.residual,
          .localised = std::max(std::abs(at.tangent.dlambda) * width + 0.5 * bend * width * width, roundoff),
          .unstable_before = after_.unstable,
          .unstable_after = detector.kind == EventKind::limit_point ? beyond.count.unstable : at.count.unstable};
}

// Leaves a corner by one of its rays; `at` becomes the same point on that ray's piece. False, and the branch ends, if
// there is none.
bool Tracer::turn_corner(PathPoint& at, Index landed, double slack, std::vector<Event>& events) {
  if (standing_ > max_standing) {
    end_ = {.reason = EndReason::no_ray, .detail = "the contacts keep changing at one point; try a finer mesh"};
    return false;
  }
  const PathPoint before = at;
  std::vector<Index> weak = system_.weak_guards(at.state, std::max(options_.guard_tolerance, 2.0 * slack));
  if (landed >= 0 && std::find(weak.begin(), weak.end(), landed) == weak.end()) weak.push_back(landed);
  std::optional<Index> unstable;
  const auto ray = choose(rays_of(system_, at.state, weak, options_.corner), at, unstable);
  if (!ray) return false;
  const State state = system_.with_piece(at.state, ray->piece);
  const Metric metric(system_.weights(ray->piece), metric_.lambda_scale());
  CorrectorResult result = corrector_.inspect(state, metric, ray->direction);
  if (!result.converged()) {
    end_ = {.reason = EndReason::singular, .detail = "behind a change of contact"};
    return false;
  }
  metric_ = metric;
  const double arc = at.arc;
  const int iterations = at.iterations;
  at = point_of(std::move(result), ray->direction);
  at.arc = arc;
  at.iterations = iterations;
  at.count = counter_.count(at.state, std::nullopt);
  if (unstable) at.count.unstable = unstable;
  add_corner_events(before, at, events);
  if (!others_.empty() && points_ > 0) events.push_back(one_sided_branch_point(before, at));
  return true;
}

// Several rays leave: each of those not taken begins a branch of its own.
Event Tracer::one_sided_branch_point(const PathPoint& before, const PathPoint& after) const {
  auto point = std::make_shared<BranchPoint>();
  point->type = BranchType::one_sided;
  point->state = after.state;
  point->along = after.tangent;
  point->discretisation = options_.tied_contacts;
  for (const Ray& ray : others_) {
    const Metric metric(system_.weights(ray.piece), metric_.lambda_scale());
    point->rays.push_back({.piece = ray.piece, .direction = unit(metric, ray.direction)});
  }
  return {.kind = EventKind::branch_point,
          .state = after.state,
          .arc = after.arc,
          .residual = before.residual,
          .unstable_before = after_.unstable,
          .unstable_after = after.count.unstable,
          .branching = std::move(point)};
}

// A direction with all contacts open, of unit length: how the structure moves.
Direction Tracer::open_direction(const Direction& direction, const Piece& piece) const {
  const Piece open(piece.size(), 0);
  const Metric metric(system_.weights(open), metric_.lambda_scale());
  return unit(metric, {.dx = system_.transfer(direction.dx, piece, open), .dlambda = direction.dlambda});
}

// Of the rays that were not taken before: the stable one; of several the one nearest the incoming direction; if none is
// stable, the one with fewest unstable directions that leaves the old piece (docs/theory.md, section 4).
std::optional<Ray> Tracer::choose(std::vector<Ray> rays, const PathPoint& at, std::optional<Index>& unstable) {
  const Piece open(at.state.piece.size(), 0);
  const Metric metric(system_.weights(open), metric_.lambda_scale());
  const State here = system_.with_piece(at.state, open);
  const Direction incoming = open_direction(at.tangent, at.state.piece);
  const auto way = [&](const Ray& ray) { return open_direction(ray.direction, ray.piece); };

  const auto known = [&](const Visited& v) { return metric.norm(difference(v.corner, here)) <= same_place; };
  auto visited = std::find_if(visited_.begin(), visited_.end(), known);
  if (visited == visited_.end()) visited = visited_.insert(visited_.end(), {.corner = here, .ways = {}});
  const bool again = !visited->ways.empty();
  visited->ways.push_back(reversed(incoming));
  std::erase_if(rays, [&](const Ray& ray) {
    const Direction direction = way(ray);
    const auto taken = [&](const Direction& d) { return metric.inner(d, direction) > same_way; };
    return std::any_of(visited->ways.begin(), visited->ways.end(), taken);
  });
  if (rays.empty()) {
    end_ = again ? BranchEnd{.reason = EndReason::closed_loop, .detail = "the branch came back to a change of contact"}
                 : BranchEnd{.reason = EndReason::no_ray, .detail = "no equilibrium leaves the change of contact"};
    return std::nullopt;
  }
  struct Rank {
    bool unstable, continues;  // a continuation of the old piece only where nothing else leaves
    Index count;
    double backward;
    auto operator<=>(const Rank&) const = default;
  };
  const auto count_of = [&](const Ray& ray) {
    Piece strong = strongly_closed(system_, at.state, options_.guard_tolerance);
    for (std::size_t j = 0; j < strong.size(); ++j)
      if (ray.loading[j]) strong[j] = 1;
    return counter_.negative_on(system_.with_piece(at.state, strong));
  };
  std::optional<Ray> best;
  Rank best_rank{};
  std::size_t chosen = 0;
  for (Ray& ray : rays) {
    const std::optional<Index> count = count_of(ray);
    const Index negative = count.value_or(std::numeric_limits<Index>::max());
    const bool continues = ray.piece == at.state.piece;
    const Rank rank{.unstable = negative > 0,
                    .continues = negative > 0 && continues != options_.stay,
                    .count = negative,
                    .backward = -metric.inner(way(ray), incoming)};
    if (best && !(rank < best_rank)) continue;
    best_rank = rank;
    best = ray;
    chosen = static_cast<std::size_t>(&ray - rays.data());
    unstable = count;
  }
  visited->ways.push_back(way(*best));
  rays.erase(rays.begin() + static_cast<std::ptrdiff_t>(chosen));
  others_ = std::move(rays);
  return best;
}

void Tracer::add_corner_events(const PathPoint& before, const PathPoint& after, std::vector<Event>& events) const {
  Event event{.state = after.state,
              .arc = after.arc,
              .residual = before.residual,
              .localised = 0.0,
              .unstable_before = after_.unstable,
              .unstable_after = after.count.unstable};
  for (const EventKind kind : {EventKind::contact_closes, EventKind::contact_opens}) {
    event.kind = kind;
    event.guards.clear();
    for (std::size_t j = 0; j < after.state.piece.size(); ++j)
      if (before.state.piece[j] != after.state.piece[j] &&
          (after.state.piece[j] != 0) == (kind == EventKind::contact_closes))
        event.guards.push_back(static_cast<Index>(j));
    if (!event.guards.empty()) events.push_back(event);
  }
  if (points_ == 0) return;
  const std::vector<int> now = signs_at(after);
  for (std::size_t i = 0; i < detectors_.size(); ++i) {
    if (now[i] * signs_[i] >= 0) continue;
    event.kind = detectors_[i].kind == EventKind::limit_point ? EventKind::contact_limit_point : detectors_[i].kind;
    event.label = detectors_[i].label;
    events.push_back(event);
  }
}

PathPoint Tracer::point_of(CorrectorResult result, const Direction& forward) const {
  PathPoint point;
  const Metric metric(system_.weights(result.state.piece), metric_.lambda_scale());
  point.tangent =
      metric.inner(result.tangent, forward) >= 0.0 ? std::move(result.tangent) : reversed(std::move(result.tangent));
  point.state = std::move(result.state);
  point.held = point.count.unstable = result.negative;
  point.iterations = result.iterations;
  point.residual = result.residual;
  point.guards = system_.guards(point.state);
  point.guard_rates = system_.guard_rates(point.state, point.tangent);
  return point;
}

std::vector<int> Tracer::signs_at(const PathPoint& point) const {
  std::vector<int> signs;
  for (const EventDetector& detector : detectors_) signs.push_back(sign_of(detector.value(point)));
  return signs;
}

// Whether the step passes a point: it lies beside the chord, and on the path as exactly as such points are located.
bool Tracer::passes(const PathPoint& to, const State& place) {
  const Segment segment(metric_, here_, to);
  const double L = segment.length();
  if (place.piece != to.state.piece) return false;
  const Direction offset = difference(place, here_.state);
  const double t = metric_.inner(offset, segment.chord()) / (L * L);
  if (!(t > 0.0 && t <= 1.0 + same_place)) return false;
  const double beside = std::sqrt(std::max(0.0, metric_.inner(offset, offset) - t * t * L * L));
  if (beside > 0.25 * L) return false;
  const auto at = correct_onto(PlaneConstraint(metric_, place, segment.chord(), 0.0), segment, std::min(t, 1.0));
  return at && metric_.norm(difference(at->state, place)) <= passing;
}

void Tracer::end_where_known(const PathPoint& to) {
  const bool far = to.arc > 3.0 * Segment(metric_, here_, to).length() + same_place;
  if (far && passes(to, start_.state))
    end_ = {.reason = EndReason::closed_loop, .detail = "the branch came back to its start"};
  for (const KnownPoint& known : start_.known) {
    if (end_ || !far) return;
    if (passes(to, known.state))
      end_ = {.reason = EndReason::joined,
              .detail = "joins branch " + std::to_string(known.branch),
              .partner = known.branch};
  }
}

void Tracer::give_up() {
  const bool controlled = options_.method == PathMethod::load || options_.method == PathMethod::displacement;
  if (obstruction_) {
    end_ = {.reason = EndReason::wall_end, .detail = "a closed contact reached the end of its wall"};
  } else if (controlled) {
    end_ = {.reason = EndReason::turning_control,
            .detail = "the controlled quantity turns back; use method = \"spherical\" to go on"};
  } else if (last_failure_ == CorrectorStatus::singular) {
    end_ = {.reason = EndReason::singular, .detail = "the equations are singular ahead"};
  } else if (last_failure_ == CorrectorStatus::not_finite) {
    end_ = {.reason = EndReason::not_finite, .detail = "a step leads to numbers that are not finite"};
  } else {
    end_ = {.reason = EndReason::min_step, .detail = "no step above path.min_step succeeds"};
  }
}

}  // namespace arcwall
