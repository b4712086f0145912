#include "continuation/corners/choice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "core/turns.hpp"

namespace arcwall {

namespace {

// A direction with all contacts open, of unit length: how the structure moves.
Direction open_direction(const TraceTools& tools, const Metric& open_metric, const Direction& direction,
                         const ActiveSet& active_set) {
  return unit(open_metric, {.dx = tools.system.transfer(direction.dx, active_set, active_set.all_open()),
                            .dlambda = direction.dlambda});
}

// How good it is to go on along a direction; the least is best.
struct Rank {
  bool unstable, continues;  // of unstable ones that which keeps the old active set is last; with `stay` it is first
  bool turns;                // λ, which drives a structure that arrives stable
  Index count;
  double backward;
  auto operator<=>(const Rank&) const = default;
};

// Of several directions, `incoming` being the one by which the place was reached.
ChosenDirection best_of(TraceTools& tools, std::vector<OutgoingDirection> ways, const PathPoint& at,
                        bool arrives_stable, const Metric& open_metric, const Direction& incoming) {
  ChosenDirection chosen;
  Rank best_rank{};
  int stable = 0;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const std::optional<Index> count = count_along(tools, ways[i], at.state);
    const Index negative = count.value_or(std::numeric_limits<Index>::max());
    const bool continues = ways[i].active_set == at.state.active_set;
    stable += negative == 0;
    const Direction way = open_direction(tools, open_metric, ways[i].direction, ways[i].active_set);
    const Rank rank{.unstable = negative > 0,
                    .continues = negative > 0 && continues != tools.options.stay,
                    .turns = negative == 0 && arrives_stable && way.dlambda * incoming.dlambda < 0.0,
                    .count = negative,
                    .backward = -open_metric.inner(way, incoming)};
    if (best && !(rank < best_rank)) continue;
    best_rank = rank;
    best = i;
    chosen.unstable = count;
  }
  chosen.taken = std::move(ways[*best]);
  ways.erase(ways.begin() + static_cast<std::ptrdiff_t>(*best));
  const bool path_had_choice = stable != 1 || tools.options.every_direction;
  if (path_had_choice) chosen.untaken = std::move(ways);
  return chosen;
}

}  // namespace

void remember(std::vector<VisitedCorner>& visited, CornerVisit visit) {
  if (visit.which == visited.size()) {
    visited.push_back(std::move(visit.corner));
    return;
  }
  visited[visit.which].arc = visit.corner.arc;
  std::vector<Direction>& ways = visited[visit.which].ways;
  for (Direction& way : visit.corner.ways) ways.push_back(std::move(way));
}

ActiveSet holding_along(const TraceTools& tools, const OutgoingDirection& way, const State& corner) {
  ActiveSet active_set = strictly_active(tools.system, corner, tools.options.guard_tolerance);
  for (std::size_t j = 0; j < active_set.size(); ++j)
    active_set[j] = way.loading[j] || (active_set[j] && way.active_set[j]) ? 1 : 0;
  return active_set;
}

std::optional<Index> count_along(TraceTools& tools, const OutgoingDirection& way, const State& corner) {
  return tools.counter.negative_on(tools.system.with_active_set(corner, holding_along(tools, way, corner)));
}

Choice choose(TraceTools& tools, const std::vector<VisitedCorner>& visited, std::vector<OutgoingDirection> ways,
              const PathPoint& at, const StabilityCount& before, double lambda_scale) {
  const ActiveSet open = at.state.active_set.all_open();
  const Metric metric = tools.metric_on(open, lambda_scale);
  const State here = tools.system.with_active_set(at.state, open);
  const Direction incoming = open_direction(tools, metric, at.tangent, at.state.active_set);
  const auto opened = [&](const OutgoingDirection& way) {
    return open_direction(tools, metric, way.direction, way.active_set);
  };

  // The layout of an active set that has been left and come back to is another one with the same unknowns.
  const std::vector<Index> turning_sets = tools.system.metric(open).turning_sets;
  const auto is_here = [&](const VisitedCorner& v) {
    return std::abs(v.corner.lambda - here.lambda) <= coincidence_tolerance * metric.lambda_scale() &&
           v.corner.x.size() == here.x.size() &&
           metric.distance({.x = turned_towards(here.x, v.corner.x, turning_sets), .lambda = v.corner.lambda}, here) <=
               coincidence_tolerance;
  };
  const auto place = std::find_if(visited.begin(), visited.end(), is_here);
  std::vector<Direction> known = place == visited.end() ? std::vector<Direction>{} : place->ways;
  const bool again = !known.empty() && at.arc - place->arc > coincidence_tolerance;  // else it was never away
  const auto same_as = [&](const Direction& way) {
    return [&](const Direction& known_way) { return metric.inner(known_way, way) > same_way; };
  };
  if (!again) std::erase_if(known, same_as(incoming));  // on that way it is just now
  known.push_back(reversed(incoming));
  Choice choice{.visit = {.which = static_cast<std::size_t>(place - visited.begin()),
                          .corner = {.corner = here, .arc = at.arc, .ways = {known.back()}}}};

  std::erase_if(ways, [&](const OutgoingDirection& way) {
    const Direction direction = opened(way);
    return std::any_of(known.begin(), known.end(), same_as(direction));
  });
  if (ways.empty()) {
    choice.result = again ? BranchEnd{.reason = EndReason::closed_loop,
                                      .detail = "the branch came back to a change of contact that it had passed"}
                          : BranchEnd{.reason = EndReason::no_continuation,
                                      .detail = "no equilibrium continues the path beyond the change of contact"};
    return choice;
  }
  ChosenDirection chosen = ways.size() == 1
                               ? ChosenDirection{.taken = std::move(ways.front())}
                               : best_of(tools, std::move(ways), at, before.unstable == Index{0}, metric, incoming);
  choice.visit.corner.ways.push_back(opened(chosen.taken));
  choice.result = std::move(chosen);
  return choice;
}

}  // namespace arcwall
