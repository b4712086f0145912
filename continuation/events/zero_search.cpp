#include "continuation/events/zero_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "continuation/events/target_values.hpp"
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
    const auto zero = find(place.half_width);
    if (!zero) return {.place = place, .failure = failure_};
    place.t = (*zero)->first;
    if (is_end(*zero)) return {.place = place, .point = point_at(*zero)};
    const auto there = (*zero)->second.between ? zero : look(place.t);
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

  // The place, and the distance from it within which the zero is. Where the value goes smoothly through zero, secants
  // tell it in fewest points, and round-off over the slope is left uncertain. Where it jumps over zero, nothing is
  // known but the bracket.
  std::optional<Place> find(double& half_width) {
    // Another zero may lie at the start.
    const double near = std::abs(at_start_) > 1e-2 * range_ ? 1e-4 * range_ : 0.0;
    auto root = bracketed(near);
    if (root && root->half_width == 0.0 && blurred_ == 0.0) {
      if (const auto smooth = by_secants(seen_.find(root->at), near, half_width)) return smooth;
      root = bracketed(0.0);
    }
    if (!root) return std::nullopt;
    half_width = std::max({tolerance(), blurred_, 2.0 * root->half_width});
    return seen_.find(root->at);
  }

  // By bracketing, first where the cubic turns, until a value is as near zero as `near`: then the bracket has no width.
  std::optional<Root> bracketed(double near) {
    best_ = seen_.end();
    seen_.erase(std::next(seen_.begin()), std::prev(seen_.end()));
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
    const auto root = bracketed_root([&](double t) { return value(t, near); }, from, at_from, until, at_until,
                                     tools_.options.localisation);
    return root && (seen_.contains(root->at) || look(root->at)) ? root : std::nullopt;
  }

  // Zero where the bracket need be no narrower.
  std::optional<double> value(double t, double near) {
    // A value that lies beyond those of near points by more than these differ is round-off. A jump stays between them.
    constexpr double near_by = 1e-3;
    const auto behind = seen_.lower_bound(t), before = std::prev(behind);
    const double width = behind->first - before->first;
    const auto [low, high] = std::minmax({before->second.v, behind->second.v});
    const auto at = look(t);
    if (!at) return std::nullopt;
    const double v = (*at)->second.v;
    if (width <= near_by && std::max(low - v, v - high) > high - low) blurred_ = width;
    return blurred_ > 0.0 || std::abs(v) <= near ? 0.0 : v;
  }

  // By secants, as long as they make the value much less: then it is round-off, or it jumps, and there is no zero.
  std::optional<Place> by_secants(Place best, double near, double& half_width) {
    constexpr double much_less = 0.1;
    half_width = tolerance();
    for (int secant = 0; secant < 4 && std::abs(best->second.v) > tolerance() * range_; ++secant) {
      best_ = best;
      const auto behind = std::next(best), before = best == seen_.begin() ? behind : std::prev(best);
      const bool ahead = behind != seen_.end() && behind->first - best->first < best->first - before->first;
      const auto& other = ahead ? behind : before;
      const double slope = (other->second.v - best->second.v) / (other->first - best->first);
      const double t = best->first - best->second.v / slope, v = best->second.v;
      if (!(t > 0.0 && t < 1.0)) return std::nullopt;
      const auto next = look(t);
      if (!next) return std::nullopt;
      if (std::abs((*next)->second.v) < std::abs(v)) best = best_ = *next;
      half_width = std::max(tolerance(), std::abs(best->second.v / slope));
      if (std::abs((*next)->second.v) < much_less * std::abs(v)) continue;
      const auto hidden = hidden_within(best->first, near, half_width);
      if (!hidden) return std::nullopt;
      half_width = *hidden;
      break;
    }
    return best;
  }

  // How far round-off hides a zero: from there on the value has its signs on both sides, still near zero. Empty where
  // it jumps.
  std::optional<double> hidden_within(double t, double near, double distance) {
    for (; t - distance > 0.0 && t + distance < 1.0; distance *= 2.0) {
      const auto before = look(t - distance), behind = before ? look(t + distance) : before;
      if (!behind) break;
      const double a = (*before)->second.v, b = (*behind)->second.v;
      if (std::max(std::abs(a), std::abs(b)) > near) break;
      if (a * at_start_ > 0.0 && b * at_end_ > 0.0) return distance;
    }
    return std::nullopt;
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

namespace {

// Where a quantity comes to its value, at which it may stay: the first point that has it but for round-off.
LocatedEvent locate_arrival(TraceTools& tools, const StepOrigin& origin, EventPlace place, const TargetValue& target,
                            const PathPoint& to) {
  const Segment segment(origin.metric, origin.point(), to);
  const double v0 = excess(target, origin.point().state), v1 = excess(target, to.state);
  const double noise = 0.5 * excess_noise(target, v0, v1), sign = std::copysign(1.0, v0);
  LocatedEvent arrival{.place = place, .point = to};
  arrival.place.t = 1.0;
  const auto before_it = [&](double t) -> std::optional<double> {
    const ChordPlaneConstraint plane(origin.metric, segment.from().state, segment.to().state, t);
    CorrectedPoint there = correct_onto(tools, origin, plane, segment, t);
    arrival.failure = there.status;
    if (!there.point) return std::nullopt;
    const double left = sign * excess(target, there.point->state) - noise;
    if (left <= 0.0 && t < arrival.place.t) {
      arrival.place.t = t;
      arrival.point = std::move(there.point);
    }
    return left;
  };
  const double at_start = sign * v0 - noise, at_end = sign * v1 - noise;
  const auto root = at_start > 0.0 && at_end <= 0.0
                        ? bracketed_root(before_it, 0.0, at_start, 1.0, at_end, tools.options.localisation)
                        : std::nullopt;
  if (!root) arrival.point.reset();
  if (root) arrival.place.half_width = 2.0 * root->half_width + tools.options.localisation;
  return arrival;
}

// A value is solved for, unless the quantity stays at it, as a force does on a level part of a wall.
LocatedEvent locate_value(TraceTools& tools, const StepOrigin& origin, const EventPlace& place, const PathPoint& to) {
  const TargetValue& target = tools.options.target_values[place.which];
  const ValueConstraint constraint(*target.quantity, target.value);
  const Segment segment(origin.metric, origin.point(), to);
  CorrectedPoint at = correct_onto(tools, origin, constraint, segment, place.t);
  const double v0 = excess(target, origin.point().state);
  const auto stays = [&](const PathPoint& point) {
    const double v = excess(target, point.state), noise = excess_noise(target, v0, v);
    const double rate = target.quantity->rate(point.state, point.tangent);
    return std::abs(v) <= noise && std::abs(rate) * segment.length() <= noise;
  };
  const PathPoint& reached = at.point ? *at.point : to;
  if (stays(reached))
    if (LocatedEvent arrival = locate_arrival(tools, origin, place, target, reached); arrival.point) return arrival;
  return {.place = place, .point = std::move(at.point), .failure = at.status};
}

}  // namespace

LocatedEvent locate(TraceTools& tools, const StepOrigin& origin, const EventPlace& place, const PathPoint& to) {
  if (place.what == EventPlace::What::target_value) return locate_value(tools, origin, place, to);
  const bool ends_slip = tools.detectors[place.which].kind == EventKind::contact_sticks;
  if (tools.options.events == EventSearch::detect && !ends_slip) {
    LocatedEvent at_end{.place = place, .point = to};
    at_end.place.t = 1.0;
    at_end.place.half_width = 0.5;
    return at_end;
  }
  return ZeroSearch(tools, origin, place.which, to).locate(place);
}

}  // namespace arcwall
