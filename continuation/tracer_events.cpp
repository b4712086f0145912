// How the tracer finds and locates what happens inside a step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/tracer.hpp"
#include "core/root_find.hpp"

namespace arcwall {

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

// The first detector or landmark with a zero inside the segment, besides the one that its end lies on.
std::optional<Tracer::Found> Tracer::earliest(const Segment& segment, const std::optional<Found>& already) const {
  std::optional<Found> first;
  const bool turns =
      !signs_.empty() && signs_.front() * sign_of(segment.to().tangent.dlambda / metric_.lambda_scale()) < 0;
  const bool whole = !already;  // counts are certain at the end of a step, not at a located point
  if (options_.events == EventSearch::locate && whole && !turns && held_ && segment.to().held &&
      *held_ != *segment.to().held && !before_double_fold(segment))
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
  if (system_.multiplier_count(to.state.piece) > 0 && branching->type == BranchType::asymmetric &&
      branching->mode.dx.size() > 0) {
    // A contact may forbid one side.
    const auto open = [&](int sign) {
      return step_off(system_, corrector_, metric_, *branching, sign, start_.distance, options_.guard_tolerance)
          .has_value();
    };
    if (open(1) != open(-1)) branching->type = BranchType::one_sided;
  }
  located_ = std::move(branching);
  return point_of(std::move(result), here_.tangent);
}

// A fold changes the count of negative eigenvalues by one, and so does a simple branch point. Where a step shows more,
// or a fold without its change, it is looked at again in shorter steps.
bool Tracer::several_singular_points(const Segment& segment) const {
  constexpr double inseparable = 1e-5, double_fold = 1e-4;  // arc length below which they are one
  if (!held_ || !segment.to().held || detectors_.empty() || before_double_fold(segment)) return false;
  const Index changes = std::abs(*segment.to().held - *held_);
  const bool turns = signs_.front() * sign_of(detectors_.front().value(segment.to())) < 0;
  if (segment.length() < (turns && changes == 2 ? double_fold : inseparable)) return false;
  return changes > 1 || (turns && changes != 1);
}

// At a fold of an arc that two like parts share, two modes turn unstable. The mesh splits them, by so little that λ has
// not turned yet when they do: they are left to the fold.
bool Tracer::before_double_fold(const Segment& segment) const {
  constexpr double level = 1e-3, close = 1e-4;  // λ′ of the unit tangent; arc length
  constexpr int patience = 20;
  if (!held_ || !segment.to().held || detectors_.empty() || left_to_fold_ >= patience) return false;
  const double rate = detectors_.front().value(segment.to());
  return *segment.to().held != *held_ && segment.length() < close && signs_.front() * sign_of(rate) >= 0 &&
         std::abs(rate) < level;
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
  const bool turns = detector.kind == EventKind::limit_point;
  // Where λ turns and no eigenvalue changes its sign, the branch meets another one at a pitchfork on that one.
  std::shared_ptr<BranchPoint> pitchfork;
  if (turns && counted_ && counted_ == beyond.count.unstable) {
    pitchfork = std::make_shared<BranchPoint>();
    pitchfork->state = at.state;
    pitchfork->along = at.tangent;
    pitchfork->discretisation = options_.tied_contacts && system_.multiplier_count(at.state.piece) > 0;
  }
  // λ changes by λ′ δ + ½ λ″ δ² over the bracket that is left.
  const double width = found.half_width * length / std::max(found.t, 1e-3);
  const double roundoff = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda);
  const double bend = std::abs(beyond.tangent.dlambda - here_.tangent.dlambda) / std::max(length, 1e-300);
  return {.kind = pitchfork ? EventKind::branch_point : detector.kind,
          .label = detector.label,
          .state = at.state,
          .arc = at.arc,
          .residual = at.residual,
          .localised = std::max(std::abs(at.tangent.dlambda) * width + 0.5 * bend * width * width, roundoff),
          .unstable_before = after_.unstable,
          .unstable_after = turns ? beyond.count.unstable : at.count.unstable,
          .branching = std::move(pitchfork)};
}

std::vector<int> Tracer::signs_at(const PathPoint& point) const {
  std::vector<int> signs;
  for (const EventDetector& detector : detectors_) signs.push_back(sign_of(detector.value(point)));
  return signs;
}

}  // namespace arcwall
