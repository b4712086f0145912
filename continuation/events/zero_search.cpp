#include "continuation/events/zero_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

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

// The zero of a detector inside a step, in planes across the chord. The point nearest the next place and an end of the
// step are what the guess there is interpolated between: soon one iteration is enough.
class ZeroSearch {
 public:
  ZeroSearch(TraceTools& tools, const StepOrigin& origin, std::size_t which, const PathPoint& to)
      : tools_(tools),
        origin_(origin),
        detector_(tools.detectors[which]),
        segment_(origin.metric, origin.point(), to),
        at_start_(start_value(detector_, origin.point(), origin.from.signs[which])),
        at_end_(detector_.value(to)),
        is_ours_(which + tools.options.detectors.size() < tools.detectors.size()),
        range_(std::abs(at_end_ - at_start_)) {
    seen_.emplace(0.0, Seen{.v = at_start_});
    seen_.emplace(1.0, Seen{.v = at_end_});
  }

  LocatedEvent locate(EventPlace place) {
    const auto root = bracketed();
    if (!root) return {.place = place, .failure = failure_};
    const auto best = sharpened(seen_.find(*root), place.half_width);
    place.t = best->first;
    if (is_end(best)) return {.place = place, .point = point_at(best)};
    const auto there = best->second.between ? std::optional(best) : look(best->first);
    if (!there) return {.place = place, .failure = failure_};
    LocatedEvent located{.place = place, .point = std::move(*(*there)->second.between)};
    seen_.clear();
    if (located.point->nearest.values.size() == 0) find_pairs(tools_, origin_.metric, *located.point);
    return located;
  }

 private:
  struct Seen {
    std::optional<PathPoint> between{};  // the ends of the step, which are the segment's; may have been forgotten
    double v;
  };
  using Place = std::map<double, Seen>::iterator;

  // Just behind the start, where the detector may still be zero.
  static double start_value(const EventDetector& detector, const PathPoint& start, int sign_behind) {
    const double sign = sign_behind, v = detector.value(start);
    return sign * v > 0.0 ? v : sign * detector_noise;
  }

  double tolerance() const { return std::max(tools_.options.localisation, 1e-10); }

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
    const Segment near(origin_.metric, point_at(before), point_at(behind));
    const double part = (t - before->first) / (behind->first - before->first);
    const ChordPlaneConstraint plane(origin_.metric, segment_.from().state, segment_.to().state, t);
    CorrectedPoint at =
        correct_onto(tools_, origin_, plane, segment_, near.at(part), near.length() * std::min(part, 1.0 - part),
                     is_ours_ ? Wanted::tangent : Wanted::pairs);
    failure_ = at.status;
    if (!at.point) return std::nullopt;
    const double v = detector_.value(*at.point);
    return seen_.insert_or_assign(t, Seen{.between = std::move(at.point), .v = v}).first;
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
                                     tools_.options.localisation);
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

  TraceTools& tools_;
  const StepOrigin& origin_;
  const EventDetector& detector_;
  Segment segment_;
  double at_start_, at_end_;
  bool is_ours_;  // and reads no pairs; of the program's own one does not know
  double range_;
  std::map<double, Seen> seen_;                           // by the fraction of the chord
  Place best_ = seen_.end();                              // so far
  double blurred_ = 0.0;                                  // width within which values are round-off
  CorrectorStatus failure_ = CorrectorStatus::converged;  // of the last correction
};

}  // namespace

LocatedEvent locate(TraceTools& tools, const StepOrigin& origin, const EventPlace& place, const PathPoint& to) {
  if (place.what == EventPlace::What::target_value) {
    const TargetValue& target = tools.options.target_values[place.which];
    const ValueConstraint constraint(*target.quantity, target.value);
    const Segment segment(origin.metric, origin.point(), to);
    CorrectedPoint at = correct_onto(tools, origin, constraint, segment, place.t);
    if (!at.point) at = correct_patiently_onto(tools, origin, constraint, segment, place.t);
    return {.place = place, .point = std::move(at.point), .failure = at.status};
  }
  if (tools.options.events == EventSearch::detect) {
    LocatedEvent at_end{.place = place, .point = to};
    at_end.place.t = 1.0;
    at_end.place.half_width = 0.5;
    return at_end;
  }
  return ZeroSearch(tools, origin, place.which, to).locate(place);
}

}  // namespace arcwall
