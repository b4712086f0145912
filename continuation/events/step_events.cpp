#include "continuation/events/step_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/events/singular_search.hpp"
#include "continuation/events/target_values.hpp"
#include "continuation/events/zero_search.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/segment.hpp"

namespace arcwall {

namespace {

// The first detector or target value with a zero inside the segment, besides the one that its end lies on.
std::optional<EventPlace> earliest(const TraceTools& tools, const std::vector<int>& signs, const Segment& segment,
                                   const std::optional<EventPlace>& already, bool over_kink) {
  std::optional<EventPlace> first;
  const auto consider = [&](EventPlace::What what, std::size_t which, double t) {
    const bool done = already && already->what == what && already->which == which;
    if (!done && (!first || t < first->t)) first = EventPlace{.what = what, .which = which, .t = t};
  };
  for (std::size_t i = 0; i < tools.detectors.size() && !over_kink; ++i) {
    const EventDetector& detector = tools.detectors[i];
    const double v0 = detector.value(segment.from()), v1 = detector.value(segment.to());
    if (!triggers(detector, signs[i], sign_of(v1))) continue;
    consider(EventPlace::What::detector, i, signs[i] * v0 > 0.0 ? v0 / (v0 - v1) : 0.0);
  }
  for (std::size_t i = 0; i < tools.options.target_values.size(); ++i) {
    const TargetValue& target = tools.options.target_values[i];
    const auto rate = [&](const PathPoint& p) { return target.quantity->rate(p.state, p.tangent); };
    const double v0 = excess(target, segment.from().state), v1 = excess(target, segment.to().state);
    const double noise = excess_noise(target, v0, v1);
    if (std::abs(v0) <= noise && std::abs(v1) <= noise) continue;  // it stays at the value
    // A step may end on the value to the last digit but one.
    if (std::abs(v1) <= noise && std::abs(v0) > noise)
      consider(EventPlace::What::target_value, i, 1.0);
    else if (const auto t = segment.first_zero(v0, rate(segment.from()), v1, rate(segment.to()), noise))
      consider(EventPlace::What::target_value, i, *t);
  }
  return first;
}

// The end of the arc becomes an event inside the step.
void end_at(ArcEnd& end, const EventPlace& event, PathPoint at) {
  if (!end.event) {
    end.beyond = std::move(end.point);
    end.changes_beyond = end.landing.has_value();
  }
  end.event = event;
  end.point = std::move(at);
  end.landing.reset();
}

Event detector_event(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end, std::size_t which,
                     const StabilityCount& behind) {
  const EventDetector& detector = tools.detectors[which];
  const PathPoint& at = end.point;
  return {.kind = detector.kind,
          .label = detector.label,
          .state = at.state,
          .arc = at.arc,
          .residual = at.residual,
          .lambda_uncertainty = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda),
          .unstable_before = origin.from.count_after.unstable,
          .unstable_after = behind.unstable,
          .extremum = extremum_at(detector.kind, origin.from.signs[which])};
}

Event located_event(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                    const StabilityCount& behind) {
  Event event = detector_event(tools, origin, end, end.event->which, behind);
  // λ changes by λ′ δ + ½ λ″ δ² over the bracket that is left.
  const double width = end.event->half_width * end.length / std::max(end.event->t, 1e-3);
  const double rate = end.point.tangent.dlambda;
  const double bend =
      std::abs(end.beyond.tangent.dlambda - origin.point().tangent.dlambda) / std::max(end.length, 1e-300);
  event.lambda_uncertainty = std::max(std::abs(rate) * width + 0.5 * bend * width * width, event.lambda_uncertainty);
  return event;
}

// At a kink λ and watched quantities turn without a zero of their rates, and eigenvalues change sign without one.
std::vector<Event> events_at_kink(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                                  const StabilityCount& behind) {
  const double off = kink_accuracy * std::abs(end.point.tangent.dlambda);
  std::vector<Event> events;
  if (tools.detectors.empty()) return events;
  const auto add = [&](std::size_t which) -> Event& {
    events.push_back(detector_event(tools, origin, end, which, behind));
    events.back().lambda_uncertainty = std::max(events.back().lambda_uncertainty, off);
    return events.back();
  };
  const std::optional<Index>& before = origin.from.count_after.unstable;
  const bool turns = triggers(tools.detectors[0], origin.from.signs[0], sign_of(tools.detectors[0].value(end.point)));
  const bool changes = before && behind.unstable && *before != *behind.unstable;
  if (turns) {
    add(0);
  } else if (changes && tools.options.events == EventSearch::locate) {
    Event& event = add(0);
    event.unconfirmed = true;
    event.extremum.reset();
  }
  for (std::size_t i = 1; i < tools.detectors.size(); ++i) {
    if (!triggers(tools.detectors[i], origin.from.signs[i], sign_of(tools.detectors[i].value(end.point)))) continue;
    Event& event = add(i);
    event.unstable_before = event.unstable_after;
  }
  return events;
}

Event branch_point_event(const StepOrigin& origin, const SingularPoint& singular, const PathPoint& at,
                         const StabilityCount& behind) {
  const double roundoff = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda);
  return {.kind = EventKind::branch_point,
          .state = at.state,
          .arc = at.arc,
          .residual = at.residual,
          .lambda_uncertainty = std::max(singular.branching->lambda_uncertainty, roundoff),
          .unconfirmed = singular.unconfirmed,
          .unstable_before = origin.from.count_after.unstable,
          .unstable_after = behind.unstable,
          .branching = singular.branching};
}

}  // namespace

ArcEndSearch locate_events(TraceTools& tools, const StepOrigin& origin, StepEnd step) {
  constexpr double same = 1e-9;  // what was located lies at the end itself
  const bool over_kink = step.over_kink && !step.landing;
  ArcEnd end{.point = std::move(step.point), .landing = step.landing, .turn = step.turn, .over_kink = over_kink};
  end.singular = origin.from.pending_singular;
  if (!over_kink && end.singular.empty() && tools.options.events != EventSearch::none) {
    SingularSearch search = find_singular(tools, origin, end.point);
    // Of spans that are too short for their unknowns counts are not sure: then the first point's own one is trusted.
    if (!search.clear && !origin.from.known_end) return {.end = std::nullopt, .failure = search.failure};
    end.singular = std::move(search.points);
  }
  if (!end.singular.empty()) end_at(end, end.singular.front().place, end.singular.front().at);
  const bool looks = !tools.detectors.empty() || !tools.options.target_values.empty();
  for (;;) {
    const Segment segment(origin.metric, origin.point(), end.point);
    end.length = segment.length();
    const auto next = looks ? earliest(tools, origin.from.signs, segment, end.event, over_kink) : std::nullopt;
    if (!next || (end.event && next->t >= 1.0 - same)) break;
    LocatedEvent located = locate(tools, origin, *next, end.point);
    if (!located.point) return {.end = std::nullopt, .failure = located.failure};
    end.singular.clear();
    end_at(end, located.place, std::move(*located.point));
    // Nothing singular lies before a value, and the count of a short span is not sure.
    if (origin.from.known_end && next->what == EventPlace::What::target_value)
      end.point.negative_eigenvalues = origin.from.negative_eigenvalues;
  }
  end.point.arc = origin.point().arc + end.length;
  return {.end = std::move(end)};
}

std::vector<Event> events_at(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                             const StabilityCount& behind) {
  if (end.over_kink) return events_at_kink(tools, origin, end, behind);
  std::vector<Event> events;
  if (!end.singular.empty()) {
    const SingularPoint& first = end.singular.front();
    if (first.branching) events.push_back(branch_point_event(origin, first, end.point, behind));
    // λ turns on the branch of a pitchfork where that is: both are one event.
    const bool is_own_pitchfork = first.branching && first.branching->ends_its_own_branch();
    if (first.place.what == EventPlace::What::detector && !is_own_pitchfork) {
      events.push_back(located_event(tools, origin, end, behind));
      events.back().unconfirmed = first.unconfirmed && !first.branching;
      if (events.back().unconfirmed) events.back().extremum.reset();  // λ touches its extreme value without turning
    }
    for (Event& event : events) event.lambda_uncertainty = std::max(event.lambda_uncertainty, first.uncertain);
  } else if (end.event && end.event->what != EventPlace::What::target_value &&
             !(end.event->what == EventPlace::What::detector &&
               tools.detectors[end.event->which].kind == EventKind::contact_sticks)) {
    events.push_back(located_event(tools, origin, end, behind));
  }
  return events;
}

// The value that was landed on, and others that are passed there.
std::vector<Event> value_crossings(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                                   const PathPoint& at, const StabilityCount& behind) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < tools.options.target_values.size(); ++i) {
    const TargetValue& target = tools.options.target_values[i];
    if (target.event.empty()) continue;
    const bool landed = end.event && end.event->what == EventPlace::What::target_value && end.event->which == i;
    if (!landed && !lies_between(target, origin.point().state, at.state)) continue;
    events.push_back(value_crossing(target, at, origin.from.count_after.unstable, behind.unstable));
    if (landed) {
      const double width = end.event->half_width * end.length / std::max(end.event->t, 1e-3);
      events.back().lambda_uncertainty =
          std::max(events.back().lambda_uncertainty, std::abs(at.tangent.dlambda) * width);
    }
  }
  return events;
}

// Behind a singular point others may follow before the step's end.
StabilityCount count_behind(TraceTools& tools, const StepOrigin& origin, const ArcEnd& end) {
  if (end.singular.empty()) return end.point.count;
  const Index change = end.singular.front().change;
  const std::optional<Index>& beyond = end.beyond.negative_eigenvalues;
  if (!end.changes_beyond && beyond && *beyond == *origin.from.negative_eigenvalues + change)
    return tools.counter.count(end.beyond.state, beyond);
  if (!origin.from.count_after.unstable) return {};
  const Index unstable = *origin.from.count_after.unstable + change;
  return {.unstable = unstable, .stability = unstable > 0 ? Stability::unstable : Stability::stable};
}

std::vector<int> signs_behind(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end) {
  const std::vector<int>& before = origin.from.signs;
  const bool touched = !end.singular.empty() && end.singular.front().unconfirmed && !end.singular.front().branching;
  std::vector<int> signs = signs_at(tools.detectors, end.point);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] == 0) signs[i] = before[i];
    const bool crossed =
        end.event && end.event->what == EventPlace::What::detector && end.event->which == i && !touched;
    if (crossed) signs[i] = -before[i];
  }
  return signs;
}

}  // namespace arcwall
