#include <algorithm>
#include <utility>

#include "continuation/corners/corner.hpp"
#include "continuation/corners/force_exchange.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

constexpr int most_changes_at_one_place = 50;

// The contacts that are degenerate at a corner, the one that was landed on among them.
std::vector<Index> degenerate_at(const TraceTools& tools, const Corner& corner, std::optional<Index> landed) {
  const double tolerance = std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
  std::vector<Index> degenerate = degenerate_contacts(corner.at.guards, corner.at.state.active_set, tolerance);
  if (landed && std::find(degenerate.begin(), degenerate.end(), *landed) == degenerate.end())
    degenerate.push_back(*landed);
  return degenerate;
}

// Each direction that is not taken begins a branch of its own.
Event one_sided_branch_point(const TraceTools& tools, const Corner& corner, const PathPoint& behind,
                             const std::vector<OutgoingDirection>& untaken) {
  auto point = std::make_shared<BranchPoint>();
  point->type = BranchType::one_sided;
  point->state = behind.state;
  point->along = behind.tangent;
  point->mesh_artefact = tools.ties_contact_to_nodes(behind.state.active_set);
  for (const OutgoingDirection& way : untaken) {
    point->mesh_artefact = point->mesh_artefact || tools.ties_contact_to_nodes(way.active_set);
    const Metric metric = tools.metric_on(way.active_set, corner.lambda_scale);
    point->ways.push_back({.active_set = way.active_set, .direction = unit(metric, way.direction)});
  }
  return {.kind = EventKind::branch_point,
          .state = behind.state,
          .arc = behind.arc,
          .residual = corner.at.residual,
          .unstable_before = corner.before.unstable,
          .unstable_after = behind.count.unstable,
          .branching = std::move(point)};
}

// Where one way leaves a corner λ turns if the number of unstable directions changes by an odd number, and only then.
bool exclude_turn(const StabilityCount& before, const StabilityCount& behind) {
  return before.unstable && behind.unstable && (*behind.unstable - *before.unstable) % 2 == 0;
}

// The state of an event at a change of contact. What presses by its deformation alone has equations that are smooth up
// to the change on the active set where it is open.
State state_of_event(const System& system, const Corner& corner, const PathPoint& behind) {
  const ActiveSet &old = corner.at.state.active_set, &now = behind.state.active_set;
  ActiveSet smooth = now;
  for (std::size_t j = 0; j < now.contacts(); ++j) {
    const auto contact = static_cast<Index>(j);
    const Enforcement how = system.enforcement(now, contact);
    if (now[j] != 0 && old[j] == 0 && how.compliance > 0.0 && !how.multiplier) smooth[j] = 0;
  }
  return smooth == now ? behind.state : system.with_active_set(behind.state, smooth);
}

std::vector<Event> events_at(const TraceTools& tools, const Corner& corner, const PathPoint& behind,
                             const std::vector<int>& signs, const std::vector<OutgoingDirection>& untaken) {
  std::vector<Event> events;
  Event event{.state = state_of_event(tools.system, corner, behind),
              .arc = behind.arc,
              .residual = corner.at.residual,
              .lambda_uncertainty = 0.0,
              .unstable_before = corner.before.unstable,
              .unstable_after = behind.count.unstable};
  const ActiveSet &old = corner.at.state.active_set, &now = behind.state.active_set;
  for (const EventKind kind : {EventKind::contact_closes, EventKind::contact_opens}) {
    event.kind = kind;
    event.guards.clear();
    for (std::size_t j = 0; j < now.contacts(); ++j)  // a kink of a law is no event
      if (old[j] != now[j] && (now[j] != 0) == (kind == EventKind::contact_closes))
        event.guards.push_back(static_cast<Index>(j));
    if (!event.guards.empty()) events.push_back(event);
  }
  if (corner.begins_branch) return events;
  add_turns(tools, corner.signs, signs, event, events);
  if (!untaken.empty()) events.push_back(one_sided_branch_point(tools, corner, behind, untaken));
  return events;
}

// The same corner behind an exchange of forces; empty where there is none.
std::optional<std::pair<Corner, Index>> behind_exchange(TraceTools& tools, const Corner& corner, Index closing) {
  const auto exchange = exchange_forces(tools, corner.at.state, closing, corner.lambda_scale);
  if (!exchange) return std::nullopt;
  Corner behind = corner;
  behind.at.state = exchange->state;
  behind.at.tangent.dx =
      tools.system.transfer(corner.at.tangent.dx, corner.at.state.active_set, exchange->state.active_set);
  behind.at.guards = tools.system.guards(exchange->state);
  behind.at.guard_rates = Vector::Zero(behind.at.guards.size());
  ++behind.without_progress;
  return std::pair(std::move(behind), exchange->without_force);
}

// The corner as a point of the active set along a direction, with the count along it.
std::optional<PathPoint> point_along(TraceTools& tools, const Corner& corner, const ChosenDirection& chosen) {
  const PathPoint& before = corner.at;
  const OutgoingDirection& way = chosen.taken;
  const State state = tools.system.with_active_set(before.state, way.active_set);
  const Metric metric = tools.metric_on(way.active_set, corner.lambda_scale);
  CorrectorResult result = tools.corrector.inspect(state, metric, way.direction);
  if (!result.converged()) return std::nullopt;
  PathPoint at = path_point(tools.system, metric, std::move(result), way.direction);
  decide_count(tools, at);
  at.arc = before.arc;
  at.iterations = before.iterations;
  std::optional<Index> unstable = chosen.unstable;
  if (!unstable)
    unstable = holding_along(tools, way, before.state) == way.active_set ? at.negative_eigenvalues
                                                                         : count_along(tools, way, before.state);
  // Often the strongly closed contacts are those of before.
  if (before.negative_eigenvalues) tools.counter.remember(before.state, before.negative_eigenvalues);
  at.count = tools.counter.count(at.state, at.negative_eigenvalues);
  if (unstable) at.count.unstable = unstable;
  return at;
}

// Contacts that are degenerate but for the error of the mesh: of contacts that symmetry lets change at one place only
// those on equal meshes do so to the last digit.
std::vector<Index> nearly_degenerate_at(const Corner& corner, const std::vector<Index>& degenerate) {
  std::vector<Index> near = degenerate_contacts(corner.at.guards, corner.at.state.active_set, mesh_error);
  std::erase_if(near, [&](Index j) { return std::find(degenerate.begin(), degenerate.end(), j) != degenerate.end(); });
  return near;
}

// The point of the active set along a direction that is nearest to the corner, where all guards hold: contacts that
// close or open along it missed that by the error of the mesh. Empty where it is not so near.
std::optional<PathPoint> point_beside(TraceTools& tools, const Corner& corner, const OutgoingDirection& way) {
  constexpr double beside = singular_point_accuracy;
  const Metric metric = tools.metric_on(way.active_set, corner.lambda_scale);
  const State here = tools.system.with_active_set(corner.at.state, way.active_set);
  const Direction forward = unit(metric, way.direction);
  double distance = 0.0;
  for (int round = 0; round < 3; ++round) {
    const State guess = moved(here, forward, distance);
    const PlaneConstraint plane(metric, guess, forward, 0.0);
    CorrectorResult result = tools.corrector.correct(guess, plane, metric, forward, beside);
    if (!result.converged() || metric.distance(result.state, here) > beside) return std::nullopt;
    PathPoint at = path_point(tools.system, metric, std::move(result), forward);
    double missing = 0.0;
    for (Index j = 0; j < at.guards.size(); ++j) {
      if (at.guards[j] >= -tools.options.guard_tolerance) continue;
      if (at.guard_rates[j] <= 0.0) return std::nullopt;
      missing = std::max(missing, -at.guards[j] / at.guard_rates[j]);
    }
    if (missing == 0.0) return at;
    distance += 1.01 * missing;
  }
  return std::nullopt;
}

// A way on from a corner that only contacts open which are nearly degenerate there, and its first point.
struct JointWay {
  Choice choice{};
  PathPoint at{};
};

// Where nothing stable leaves a corner: a stable way along which contacts change, too, that missed the corner by the
// error of the mesh. Along the path itself they change right behind it, and that way is passed by.
std::optional<JointWay> leave_jointly(TraceTools& tools, const Corner& corner, const std::vector<Index>& degenerate,
                                      const std::vector<VisitedCorner>& visited) {
  const std::vector<Index> near = nearly_degenerate_at(corner, degenerate);
  if (near.empty() || corner.begins_branch) return std::nullopt;
  std::vector<Index> all = degenerate;
  all.insert(all.end(), near.begin(), near.end());
  const State& state = corner.at.state;
  auto ways = outgoing_directions(tools.system, state, all, tools.options.corner, tools.corner_workspace);
  std::erase_if(ways, [&](const OutgoingDirection& way) {
    const bool changes = std::any_of(near.begin(), near.end(), [&](Index j) {
      return way.active_set[static_cast<std::size_t>(j)] != state.active_set[static_cast<std::size_t>(j)];
    });
    return !changes || count_along(tools, way, state) != Index{0};
  });
  if (ways.empty()) return std::nullopt;
  Choice choice = choose(tools, visited, std::move(ways), corner.at, corner.before, corner.lambda_scale);
  const auto* const chosen = std::get_if<ChosenDirection>(&choice.result);
  if (chosen == nullptr) return std::nullopt;
  auto at = point_beside(tools, corner, chosen->taken);
  if (!at) return std::nullopt;
  decide_count(tools, *at);
  at->arc = corner.at.arc;
  at->iterations = corner.at.iterations;
  at->count = tools.counter.count(at->state, at->negative_eigenvalues);
  if (at->count.unstable != Index{0}) at->count.unstable = count_along(tools, chosen->taken, at->state);
  if (at->count.unstable != Index{0}) return std::nullopt;
  return JointWay{.choice = std::move(choice), .at = std::move(*at)};
}

}  // namespace

CornerPassed turn_corner(TraceTools& tools, Corner corner, std::optional<Index> landed,
                         const std::vector<VisitedCorner>& visited) {
  CornerPassed passed{.at = corner.at, .without_progress = corner.without_progress};
  const std::vector<Index> degenerate = degenerate_at(tools, corner, landed);
  const std::optional<Index> first = landed || degenerate.empty() ? landed : std::optional(degenerate.front());
  const auto with_its_place = [&](std::string_view what) {
    return with_place(what, first ? tools.system.watched_place(corner.at.state, *first) : std::string());
  };
  if (corner.without_progress > most_changes_at_one_place) {
    passed.end = {.reason = EndReason::no_continuation,
                  .detail = with_its_place("the contacts change again and again at one point; use more elements")};
    return passed;
  }
  auto ways =
      outgoing_directions(tools.system, corner.at.state, degenerate, tools.options.corner, tools.corner_workspace);
  Choice choice = choose(tools, visited, std::move(ways), corner.at, corner.before, corner.lambda_scale);
  const auto* const end = std::get_if<BranchEnd>(&choice.result);
  std::optional<PathPoint> at;
  if (!end) at = point_along(tools, corner, std::get<ChosenDirection>(choice.result));
  if (!at || at->count.unstable != Index{0}) {
    if (auto joint = leave_jointly(tools, corner, degenerate, visited)) {
      choice = std::move(joint->choice);
      at = std::move(joint->at);
      passed.strategies.push_back(Strategy::nearly_degenerate);
    } else if (end) {
      passed.end = *end;
      passed.end->detail = with_its_place(end->detail);
    }
  }
  if (passed.end && passed.end->reason == EndReason::no_continuation && landed) {
    if (auto behind = behind_exchange(tools, corner, *landed)) {
      passed = turn_corner(tools, std::move(behind->first), behind->second, visited);
      if (!passed.events.empty()) {
        Event closes = passed.events.front();
        closes.kind = EventKind::contact_closes;
        closes.guards = {*landed};
        passed.events.insert(passed.events.begin(), std::move(closes));
      }
      return passed;
    }
  }
  passed.visit = std::move(choice.visit);
  if (passed.end) return passed;
  if (!at) {
    passed.end = {.reason = EndReason::singular, .detail = with_its_place(nothing_behind_change)};
    return passed;
  }
  const std::vector<OutgoingDirection>& untaken = std::get<ChosenDirection>(choice.result).untaken;
  passed.signs = untaken.empty() ? signs_behind_corner(tools, corner, *at) : signs_at(tools.detectors, *at);
  passed.events = events_at(tools, corner, *at, passed.signs, untaken);
  passed.at = std::move(*at);
  return passed;
}

std::vector<int> signs_behind_corner(const TraceTools& tools, const Corner& corner, const PathPoint& behind) {
  std::vector<int> signs = signs_at(tools.detectors, behind);
  if (corner.begins_branch || !exclude_turn(corner.before, behind.count)) return signs;
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (tools.detectors[i].kind == EventKind::limit_point && signs[i] == -corner.signs[i]) signs[i] = corner.signs[i];
  return signs;
}

void add_turns(const TraceTools& tools, const std::vector<int>& before, const std::vector<int>& behind, Event event,
               std::vector<Event>& events) {
  for (std::size_t i = 0; i < tools.detectors.size(); ++i) {
    const EventDetector& detector = tools.detectors[i];
    if (detector.kind == EventKind::contact_sticks || !triggers(detector, before[i], behind[i])) continue;
    event.kind = detector.kind == EventKind::limit_point ? EventKind::contact_limit_point : detector.kind;
    event.label = detector.label;
    event.extremum = extremum_at(detector.kind, before[i]);
    events.push_back(event);
  }
}

}  // namespace arcwall
