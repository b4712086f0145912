// How the tracer finds and locates what happens inside a step.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "continuation/path_tolerances.hpp"
#include "continuation/tracer.hpp"
#include "core/root_find.hpp"

namespace arcwall {

namespace {

// Where the cubic through a quantity at the ends of a segment turns, given its rates there: nearer than the straight
// line through the rates vanishes.
std::optional<double> turn_of(const std::function<double(const PathPoint&)>& quantity, const Segment& segment,
                              double rate0, double rate1) {
  const double L = segment.length();
  // Of the arc length over that of the chord, where the path leaves it at an angle.
  const auto stretch = [&](const PathPoint& point) { return 1.0 / segment.cosine(point.tangent); };
  return cubic_turn(quantity(segment.from()), rate0 * L * stretch(segment.from()), quantity(segment.to()),
                    rate1 * L * stretch(segment.to()));
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

// λ may turn twice inside a step, or nearly, and look as if it had not: then the cubic through its ends does. `part`:
// of the lesser rate at the ends, below which the least rate inside must lie; a negative one is taken as it is.
bool Tracer::hides_two_zeros(const Segment& segment, double part) const {
  // Between a point so near a corner and the corner itself nothing but round-off is seen.
  if (segment.length() <= coincidence_tolerance) return false;
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
    const double t = -slope / (2.0 * curvature), bound = part > 0.0 ? part * std::min(a, b) : part;
    if (t > 0.0 && t < 1.0 && a + t * (slope + t * curvature) < bound) return true;
  }
  return false;
}

// The first detector or target_value with a zero inside the segment, besides the one that its end lies on.
std::optional<Tracer::Found> Tracer::earliest(const Segment& segment, const std::optional<Found>& already) const {
  std::optional<Found> first;
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
  for (std::size_t i = 0; i < options_.target_values.size(); ++i) {
    const TargetValue& mark = options_.target_values[i];
    const auto value = [&](const PathPoint& p) { return mark.quantity->value(p.state) - mark.value; };
    const auto rate = [&](const PathPoint& p) { return apply(mark.quantity->gradient(p.state), p.tangent); };
    const double v0 = value(segment.from()), v1 = value(segment.to());
    const double noise = 1e-11 * std::max({std::abs(mark.value), std::abs(v0), std::abs(v1)});
    // A step may end on the mark to the last digit but one.
    if (std::abs(v1) <= noise && std::abs(v0) > noise)
      consider(Found::What::target_value, i, 1.0);
    else if (const auto t = segment.first_zero(v0, rate(segment.from()), v1, rate(segment.to()), noise))
      consider(Found::What::target_value, i, *t);
  }
  return first;
}

// The zero of a detector inside a step, in planes across the chord. The point nearest the next place and an end of the
// step are what the guess there is interpolated between: soon one iteration is enough.
class Tracer::ZeroSearch {
 public:
  ZeroSearch(Tracer& tracer, std::size_t which, const PathPoint& to)
      : tracer_(tracer),
        detector_(tracer.detectors_[which]),
        segment_(tracer.metric_, tracer.here_, to),
        at_start_(start_value(tracer, which)),
        at_end_(detector_.value(to)),
        is_ours_(which + tracer.options_.detectors.size() < tracer.detectors_.size()),
        range_(std::abs(at_end_ - at_start_)) {
    seen_.emplace(0.0, Seen{.v = at_start_});
    seen_.emplace(1.0, Seen{.v = at_end_});
  }

  /// The point, and where it lies; empty if the search fails.
  std::optional<PathPoint> point(Found& found) {
    const auto root = bracketed();
    if (!root) return std::nullopt;
    const auto best = sharpened(seen_.find(*root), found.half_width);
    found.t = best->first;
    if (is_end(best)) return point_at(best);
    const auto there = best->second.between ? std::optional(best) : look(best->first);
    if (!there) return std::nullopt;
    PathPoint at = std::move(*(*there)->second.between);
    seen_.clear();
    if (at.nearest.values.size() == 0) tracer_.find_pairs(at);
    return at;
  }

 private:
  struct Seen {
    std::optional<PathPoint> between{};  // the ends of the step, which are the segment's; may have been forgotten
    double v;
  };
  using Place = std::map<double, Seen>::iterator;

  // Just behind the start, where the detector may still be zero.
  static double start_value(const Tracer& tracer, std::size_t which) {
    const double sign = tracer.signs_[which], v = tracer.detectors_[which].value(tracer.here_);
    return sign * v > 0.0 ? v : sign * detector_noise;
  }

  double tolerance() const { return std::max(tracer_.options_.localisation, 1e-10); }

  static bool is_end(Place place) { return place->first == 0.0 || place->first == 1.0; }
  bool has_point(Place place) const { return is_end(place) || place->second.between; }
  const PathPoint& point_at(Place place) const {
    if (place->second.between) return *place->second.between;
    return place->first == 0.0 ? segment_.from() : segment_.to();
  }

  std::optional<Place> look(double t) {
    forget_all_but_nearest(t);
    auto behind = seen_.lower_bound(t), before = std::prev(behind);
    while (!has_point(before)) --before;
    while (!has_point(behind)) ++behind;
    const Segment near(tracer_.metric_, point_at(before), point_at(behind));
    const double part = (t - before->first) / (behind->first - before->first);
    const ChordPlaneConstraint plane(tracer_.metric_, segment_.from().state, segment_.to().state, t);
    auto point = tracer_.correct_onto(plane, segment_, near.at(part), near.length() * std::min(part, 1.0 - part),
                                      is_ours_ ? Wanted::tangent : Wanted::pairs);
    if (!point) return std::nullopt;
    const double v = detector_.value(*point);
    return seen_.insert_or_assign(t, Seen{.between = std::move(point), .v = v}).first;
  }

  // Points are large: between the ends the nearest one stays, and the best. Pairs are asked for at the zero alone.
  void forget_all_but_nearest(double t) {
    Place nearest = seen_.end();
    for (Place place = seen_.begin(); place != seen_.end(); ++place)
      if (place->second.between &&
          (nearest == seen_.end() || std::abs(place->first - t) < std::abs(nearest->first - t)))
        nearest = place;
    for (Place place = seen_.begin(); place != seen_.end(); ++place) {
      std::optional<PathPoint>& point = place->second.between;
      if (place != nearest && place != best_)
        point.reset();
      else if (point)
        point->nearest = {};
    }
  }

  // Zero where the bracket need be no narrower.
  std::optional<double> value(double t) {
    // Near the zero it need not be closed from both sides, unless another lies at the start.
    const double near_zero = std::abs(at_start_) > 1e-2 * range_ ? 1e-4 : 0.0;
    // Between near points a value that is off their straight line by more than they differ is round-off.
    constexpr double straight = 1e-3;
    const auto behind = seen_.lower_bound(t), before = std::prev(behind);
    const double width = behind->first - before->first, change = behind->second.v - before->second.v;
    const double expected = before->second.v + (t - before->first) / width * change;
    const auto at = look(t);
    if (!at) return std::nullopt;
    const double v = (*at)->second.v;
    if (width <= straight && std::abs(v - expected) > std::abs(change)) blurred_ = width;
    return blurred_ > 0.0 || std::abs(v) <= near_zero * range_ ? 0.0 : v;
  }

  // By bracketing, first where the cubic turns.
  std::optional<double> bracketed() {
    double from = 0.0, at_from = at_start_, until = 1.0, at_until = at_end_;
    const double v0 = detector_.value(segment_.from());
    if (const auto turn = detector_.integral ? turn_of(detector_.integral, segment_, v0, at_end_) : std::nullopt) {
      const auto at = look(*turn);
      if (!at) return std::nullopt;
      const double v = (*at)->second.v;
      const bool before = v * at_start_ > 0.0;
      (before ? from : until) = *turn;
      (before ? at_from : at_until) = v;
    }
    const auto root = bracketed_root([this](double t) { return value(t); }, from, at_from, until, at_until,
                                     tracer_.options_.localisation);
    return root && (seen_.contains(root->at) || look(root->at)) ? std::optional(root->at) : std::nullopt;
  }

  // By secants, as long as they make the value much less: then it is round-off.
  Place sharpened(Place best, double& half_width) {
    constexpr double much_less = 0.1;
    best_ = best;
    half_width = std::max(tolerance(), blurred_);
    for (int secant = 0; secant < 4 && blurred_ == 0.0 && std::abs(best->second.v) > tolerance() * range_; ++secant) {
      const auto behind = std::next(best), before = best == seen_.begin() ? behind : std::prev(best);
      const bool ahead = behind != seen_.end() && behind->first - best->first < best->first - before->first;
      const auto& other = ahead ? behind : before;
      const double slope = (other->second.v - best->second.v) / (other->first - best->first);
      const double t = best->first - best->second.v / slope;
      half_width = std::max(tolerance(), std::abs(best->second.v / slope));
      if (!(t > 0.0 && t < 1.0)) break;
      const auto next = look(t);
      if (!next) break;
      const bool noisy = std::abs((*next)->second.v) >= much_less * std::abs(best->second.v);
      if (std::abs((*next)->second.v) < std::abs(best->second.v)) best = best_ = *next;
      half_width = std::max(tolerance(), std::abs(best->second.v / slope));
      if (noisy) break;
    }
    return best;
  }

  Tracer& tracer_;
  const EventDetector& detector_;
  Segment segment_;
  double at_start_, at_end_;
  bool is_ours_;  // and reads no pairs; of the program's own one does not know
  double range_;
  std::map<double, Seen> seen_;  // by the fraction of the chord
  Place best_ = seen_.end();     // so far
  double blurred_ = 0.0;         // width within which values are round-off
};

// Lands on a target_value with its value as the constraint; a detector's zero is searched for.
std::optional<PathPoint> Tracer::locate(Found& found, const PathPoint& to) {
  if (found.what == Found::What::target_value) {
    const TargetValue& mark = options_.target_values[found.which];
    return correct_onto(ValueConstraint(*mark.quantity, mark.value), Segment(metric_, here_, to), found.t);
  }
  if (options_.events == EventSearch::detect) {
    found.half_width = 0.5;
    found.t = 1.0;
    return to;
  }
  return ZeroSearch(*this, found.which, to).point(found);
}

Event Tracer::event_of(const Found& found, const PathPoint& at, const PathPoint& beyond, const StabilityCount& behind,
                       double length) const {
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
          .unstable_after = behind.unstable};
}

bool Tracer::is_known(const Found& found) const {
  switch (found.what) {
    case Found::What::branch_point:
      return true;
    case Found::What::detector:
      return found.which < detectors_.size();
    case Found::What::target_value:
      return found.which < options_.target_values.size();
  }
  return false;
}

std::vector<int> Tracer::signs_at(const PathPoint& point) const {
  std::vector<int> signs;
  for (const EventDetector& detector : detectors_) signs.push_back(sign_of(detector.value(point)));
  return signs;
}

}  // namespace arcwall
