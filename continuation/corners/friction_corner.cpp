#include "continuation/corners/friction_corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "continuation/corners/friction_ways.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/path_constraint.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

constexpr int most_changes_here = 50;

// The sign of the determinant of the equations times that of the rate of λ, which goes on through a corner.
std::optional<int> orientation(std::optional<Index> negative, const Direction& direction) {
  if (!negative || direction.dlambda == 0.0) return std::nullopt;
  return (*negative % 2 == 0 ? 1 : -1) * sign_of_rate(direction.dlambda);
}

// How good it is to go on along a way; the least is best.
struct FrictionRank {
  bool turns_over;  // the orientation changes
  int kind;         // λ goes on, stable; λ goes on; λ turns
  Index unstable;
  double less_dissipation;  // its negative
  double backward;
  auto operator<=>(const FrictionRank&) const = default;
};

// That every contact sticks and λ turns is unloading, which nobody has asked for.
bool unloads(const Continuation& way, const std::vector<BoundContact>& choices, double sense) {
  if (way.direction.dlambda * sense >= 0.0) return false;
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (choices[i].touches || way.modes[i].mode != ContactMode::sticks) return false;
  return true;
}

// Whether two walls would hold one point by friction: four forces, of which equilibrium determines two.
bool would_hold_twice(const FrictionalContact& friction, const ActiveSet& active_set,
                      const std::vector<BoundContact>& choices) {
  const auto touches = [&](Index j) {
    return friction.mode(active_set, j) != ContactMode::open ||
           std::any_of(choices.begin(), choices.end(), [j](const BoundContact& other) { return other.contact == j; });
  };
  for (const BoundContact& choice : choices)
    for (Index j = 0; j < static_cast<Index>(active_set.contacts()); ++j)
      if (choice.touches && j != choice.contact && friction.share_point(active_set, j, choice.contact) && touches(j))
        return true;
  return false;
}

std::string event_place(const TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices) {
  return choices.empty() ? std::string() : tools.system.watched_place(corner.at.state, choices.front().contact);
}

std::vector<Event> events_between(const TraceTools& tools, const Corner& corner, const PathPoint& behind,
                                  const Event& event) {
  const FrictionalContact& friction = *tools.system.friction();
  const ActiveSet &old = corner.at.state.active_set, &now = behind.state.active_set;
  std::vector<Event> events;
  for (const EventKind kind :
       {EventKind::contact_closes, EventKind::contact_opens, EventKind::contact_slips, EventKind::contact_sticks}) {
    Event changes = event;
    changes.kind = kind;
    for (Index j = 0; j < static_cast<Index>(now.contacts()); ++j) {
      const ContactMode before = friction.mode(old, j), after = friction.mode(now, j);
      const bool stays_closed = before != ContactMode::open && after != ContactMode::open && before != after;
      if ((kind == EventKind::contact_closes && before == ContactMode::open && after != ContactMode::open) ||
          (kind == EventKind::contact_opens && before != ContactMode::open && after == ContactMode::open) ||
          (kind == EventKind::contact_slips && stays_closed && slips(after)) ||
          (kind == EventKind::contact_sticks && stays_closed && after == ContactMode::sticks))
        changes.guards.push_back(j);
    }
    if (!changes.guards.empty()) events.push_back(std::move(changes));
  }
  return events;
}

// What holds a state of a corner on the path: across its direction, or where a branch begins at its λ, which is given.
CorrectorResult held_at_corner(TraceTools& tools, const Corner& corner, const Metric& metric, const State& state,
                               const Direction& along) {
  if (!corner.begins_branch)
    return tools.corrector.correct(state, PlaneConstraint(metric, state, along, 0.0), metric, along, 0.0);
  const ParameterValue parameter;
  CorrectorResult result = tools.corrector.correct(state, ValueConstraint(parameter, state.lambda), metric, along, 0.0);
  result.state.lambda = state.lambda;  // to the last digit
  return result;
}

// Friction is known to the error of the equations, by which contacts that stick at their bound may have passed it. They
// hold the place at which it is met.
void meet_bounds(TraceTools& tools, Corner& corner) {
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  const ActiveSet& active_set = corner.at.state.active_set;
  std::vector<ModeOfContact> at_bound, again;
  for (auto guard = static_cast<Index>(active_set.contacts()); guard < corner.at.guards.size(); ++guard) {
    if (corner.at.guards[guard] >= -tools.options.guard_tolerance) continue;
    if (const auto beyond = friction.beyond_friction_bound(active_set, guard)) {
      at_bound.push_back(*beyond);
      again.push_back({.contact = beyond->contact, .mode = ContactMode::sticks});
    }
  }
  if (at_bound.empty()) return;
  const State start = friction.with_modes(corner.at.state, at_bound);
  const Metric metric = tools.metric_on(start.active_set, corner.lambda_scale);
  const Direction along = unit(metric, {.dx = system.transfer(corner.at.tangent.dx, active_set, start.active_set),
                                        .dlambda = corner.at.tangent.dlambda});
  const CorrectorResult met = held_at_corner(tools, corner, metric, start, along);
  if (!met.converged()) return;
  corner.at.state = friction.with_modes(met.state, again);
  corner.at.guards = system.guards(corner.at.state);
}

// Why the path ends at a corner whatever leads on: it is never left, or what its contacts do is not modelled.
std::optional<BranchEnd> end_at(const TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices,
                                const std::string& place) {
  if (corner.without_progress > most_changes_here)
    return BranchEnd{
        .reason = EndReason::no_continuation,
        .detail = with_place("the contacts change again and again at one point; use more elements", place)};
  const FrictionalContact& friction = *tools.system.friction();
  const ActiveSet& active_set = corner.at.state.active_set;
  if (would_hold_twice(friction, active_set, choices))
    return BranchEnd{.reason = EndReason::not_modelled,
                     .detail = with_place("two frictions at one end are not determined by equilibrium", place)};
  for (const BoundContact& choice : choices) {
    if (!choice.touches) continue;
    if (std::string why = friction.why_not_modelled(active_set, choice.contact); !why.empty())
      return BranchEnd{.reason = EndReason::not_modelled, .detail = with_place(std::move(why), place)};
  }
  return std::nullopt;
}

// How ways on lie to the direction in which the path comes to the corner.
class Incoming {
 public:
  Incoming(const TraceTools& tools, const Corner& corner)
      : tools_(tools),
        corner_(corner),
        metric_(tools.metric_on(corner.at.state.active_set.all_open(), corner.lambda_scale)),
        motion_(motion_along(tools, corner, corner.at.state, corner.at.tangent)) {
    const std::optional<Index> before =
        corner.at.negative_eigenvalues ? corner.at.negative_eigenvalues : corner.before.unstable;
    if (!corner.begins_branch) orientation_ = orientation(before, corner.at.tangent);
  }

  double cosine(const Continuation& way) const {
    return metric_.inner(motion_along(tools_, corner_, way.state, way.direction), motion_);
  }
  bool turns_over(const Continuation& way) const {
    const auto turned = orientation(way.unstable, way.direction);
    return orientation_ && turned && *orientation_ != *turned;
  }

 private:
  const TraceTools& tools_;
  const Corner& corner_;
  Metric metric_;
  Direction motion_;
  std::optional<int> orientation_{};
};

// Leaves those of the ways on which the path may take; `ended`: the slip that ends at the corner.
void keep_fit(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices, double sense,
              std::optional<Index> ended, const Incoming& incoming, std::vector<Continuation>& ways) {
  std::erase_if(ways, [&](const Continuation& way) {
    return (!corner.begins_branch && incoming.cosine(way) < -same_way) || unloads(way, choices, sense);
  });
  for (Continuation& way : ways) way.unstable = tools.counter.negative_on(way.state);
  // A stick has the tangent of the slip that ends, and leaves its bound by −½ D v′ s² (18.4a): D < 0 turns over.
  if (ended)
    std::erase_if(ways,
                  [&](const Continuation& way) { return incoming.cosine(way) > same_way && incoming.turns_over(way); });
  const auto turns = [&](const Continuation& way) { return way.direction.dlambda * sense < 0.0; };
  if (corner.begins_branch && !std::all_of(ways.begin(), ways.end(), turns)) std::erase_if(ways, turns);
}

BranchEnd none_leads_on(const std::vector<BoundContact>& choices, bool all_known, const std::string& place) {
  if (!all_known)
    return {.reason = EndReason::no_continuation,
            .detail = with_place("of " + std::to_string(choices.size()) +
                                     " contacts that may stick, slip or open here no motion was found in which "
                                     "friction opposes slip",
                                 place)};
  return {.reason = EndReason::jammed,
          .detail = with_place("no motion in which friction opposes slip leads on: the load can go no further "
                               "in this sense; let a stage drive back, or lower the friction",
                               place)};
}

// The first by rank; each is told what it dissipates.
const Continuation& best_of(const FrictionalContact& friction, double sense, const Incoming& incoming,
                            std::vector<Continuation>& ways) {
  std::optional<FrictionRank> best;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    Continuation& way = ways[i];
    way.dissipation = dissipation_along(friction, way);
    const bool goes_on = way.direction.dlambda * sense > 0.0;
    const FrictionRank rank{.turns_over = incoming.turns_over(way),
                            .kind = !goes_on                   ? 2
                                    : way.unstable == Index{0} ? 0
                                                               : 1,
                            .unstable = way.unstable.value_or(std::numeric_limits<Index>::max()),
                            .less_dissipation = -way.dissipation,
                            .backward = -incoming.cosine(way)};
    if (best && !(rank < *best)) continue;
    best = rank;
    chosen = i;
  }
  return ways[chosen];
}

// The corner as the first point of a way on; empty where that is no equilibrium. Bounds that were reached together but
// for an error are met by all from here on.
std::optional<PathPoint> first_of(TraceTools& tools, const Corner& corner, const Continuation& way) {
  const Metric metric = tools.metric_on(way.state.active_set, corner.lambda_scale);
  CorrectorResult result = held_at_corner(tools, corner, metric, way.state, way.direction);
  if (!result.converged()) return std::nullopt;
  PathPoint at = path_point(tools.system, metric, std::move(result), way.direction);
  decide_count(tools, at);
  at.arc = corner.at.arc;
  at.iterations = corner.at.iterations;
  at.count = tools.counter.count(at.state, at.negative_eigenvalues);
  if (way.unstable) at.count.unstable = way.unstable;  // contacts that touch without a force hold along the way
  return at;
}

}  // namespace

std::vector<EventDetector> slip_end_detectors(const System& system) {
  std::vector<EventDetector> detectors;
  const FrictionalContact* const friction = system.friction();
  if (friction == nullptr) return detectors;
  const ActiveSet open = system.open_active_set();
  if (friction->contacts_move()) {
    const auto least = [friction](const PathPoint& at) {
      const auto slip = slowest_slip(*friction, at);
      return slip ? friction->slip_rate(at.state, at.tangent, *slip) : 0.0;
    };
    detectors.push_back(
        {.kind = EventKind::contact_sticks, .crossing = Crossing::falling, .value = least, .integral = nullptr});
    return detectors;
  }
  for (Index j = 0; j < static_cast<Index>(open.contacts()); ++j) {
    if (!friction->is_rough(open, j)) continue;
    const auto rate = [friction, j](const PathPoint& at) { return friction->slip_rate(at.state, at.tangent, j); };
    // The place is an unknown, so that the rate along the unknowns themselves is the slip.
    const auto slip = [friction, j](const PathPoint& at) {
      return friction->slip_rate(at.state, {.dx = at.state.x, .dlambda = 0.0}, j);
    };
    detectors.push_back({.kind = EventKind::contact_sticks,
                         .label = std::to_string(j),
                         .crossing = Crossing::falling,
                         .value = rate,
                         .integral = slip});
  }
  return detectors;
}

std::optional<Index> slowest_slip(const FrictionalContact& friction, const PathPoint& at) {
  std::optional<Index> slowest;
  const auto rate = [&](Index j) { return friction.slip_rate(at.state, at.tangent, j); };
  for (const Index j : friction.slipping(at.state.active_set))
    if (!slowest || rate(j) < rate(*slowest)) slowest = j;
  return slowest;
}

bool must_change_behind(const TraceTools& tools, const PathPoint& at) {
  if (!tools.system.has_friction()) return false;
  const FrictionalContact& friction = *tools.system.friction();
  const ActiveSet& active_set = at.state.active_set;
  const auto slowest = slowest_slip(friction, at);
  if (slowest && friction.slip_rate(at.state, at.tangent, *slowest) < 0.0) return true;
  for (auto guard = static_cast<Index>(active_set.contacts()); guard < at.guards.size(); ++guard)
    if (at.guards[guard] < -tools.options.guard_tolerance && is_friction_bound(tools.system, active_set, guard))
      return true;
  return false;
}

bool may_change_at_start(const TraceTools& tools, const PathPoint& at) {
  if (!tools.system.has_friction()) return false;
  const ActiveSet& active_set = at.state.active_set;
  for (auto guard = static_cast<Index>(active_set.contacts()); guard < at.guards.size(); ++guard)
    if (at.guards[guard] <= tools.options.guard_tolerance && is_friction_bound(tools.system, active_set, guard))
      return true;
  return !tools.system.slipping(active_set).empty() ||
         !degenerate_contacts(at.guards, at.state.active_set, tools.options.guard_tolerance).empty();
}

CornerPassed turn_friction_corner(TraceTools& tools, Corner corner, std::optional<Index> landed,
                                  std::optional<Index> ended) {
  meet_bounds(tools, corner);
  CornerPassed passed{.at = corner.at, .without_progress = corner.without_progress};
  const std::vector<BoundContact> choices = choices_at(tools, corner, landed, ended);
  const std::string place = event_place(tools, corner, choices);
  passed.end = end_at(tools, corner, choices, place);
  if (passed.end) return passed;

  const double sense = corner.at.tangent.dlambda < 0.0 ? -1.0 : 1.0;
  auto [ways, all_known] = ways_on(tools, corner, choices, sense);
  const Incoming incoming(tools, corner);
  keep_fit(tools, corner, choices, sense, ended, incoming, ways);
  if (ways.empty()) {
    passed.end = none_leads_on(choices, all_known, place);
    return passed;
  }
  const Continuation& taken = best_of(*tools.system.friction(), sense, incoming, ways);
  std::optional<PathPoint> at = first_of(tools, corner, taken);
  if (!at) {
    passed.end = {.reason = EndReason::singular, .detail = with_place(nothing_behind_change, place)};
    return passed;
  }
  Event event{.state = at->state,
              .arc = at->arc,
              .residual = corner.at.residual,
              .lambda_uncertainty = 0.0,
              .unstable_before = corner.before.unstable,
              .unstable_after = at->count.unstable,
              .all_ways_known = all_known};
  for (const Continuation& way : ways)
    event.friction_ways.push_back({.modes = way.modes,
                                   .lambda_sense = sign_of_rate(way.direction.dlambda),
                                   .dissipation = way.dissipation,
                                   .unstable = way.unstable,
                                   .taken = &way == &taken});
  passed.events = events_between(tools, corner, *at, event);
  for (const Event& change : passed.events)
    event.guards.insert(event.guards.end(), change.guards.begin(), change.guards.end());
  passed.signs = signs_at(tools.detectors, *at);
  if (!corner.begins_branch) add_turns(tools, corner.signs, passed.signs, event, passed.events);
  passed.at = std::move(*at);
  return passed;
}

}  // namespace arcwall
