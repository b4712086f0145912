#include "continuation/corners/friction_corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "continuation/step/path_constraint.hpp"
#include "continuation/step/point_on_path.hpp"
#include "core/algebra/slip_stiffness.hpp"
#include "core/text.hpp"

namespace arcwall {

namespace {

constexpr int most_changes_here = 50;
constexpr double rate_noise = 1e-10;         // error of rates, relative to the greatest of their kind
constexpr std::size_t few_contacts = 6;      // whose combinations are all tried
constexpr std::size_t most_combined = 4096;  // combinations of modes that are tried where nothing else is found

// A contact, and what it may do from here on; the first is what it would do at once where nothing is known: one whose
// force has vanished opens, one whose gap has closes.
struct BoundContact {
  Index contact = 0;
  std::vector<ContactMode> modes{};
  bool touches = false;  // without a force
  bool ended = false;    // its slip has: a stick has the same tangent, along which its friction stays at the bound
};

// One combination of modes: its equations hold at the corner, and the rates along the direction fulfil the law.
struct Continuation {
  std::vector<ModeOfContact> modes{};
  State state{};
  Direction direction{};  // unit
  std::vector<Index> slipping{};
  Vector relieved{};  // by each slip alone of the friction that drives it [scale of guards]
  std::optional<Index> unstable{};
  double dissipation = 0.0;
};

double bound_tolerance(const TraceTools& tools, const Corner& corner) {
  return std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
}

// Whether a guard is zero, or nearly so and zero at a place along the path that coincides with the corner: symmetry
// lets bounds be reached together, up to round-off.
bool is_reached(double guard, double rate, double tolerance) {
  return guard <= tolerance || (guard <= coincidence_tolerance && guard <= -coincidence_tolerance * rate);
}

// The contacts that stand at a bound: those that touch without a force, those that stick with |T| = μ p, and those that
// slip, which may stick from here on.
std::vector<BoundContact> choices_at(const TraceTools& tools, const Corner& corner, std::optional<Index> landed,
                                     std::optional<Index> ended) {
  using enum ContactMode;
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  const ActiveSet& active_set = corner.at.state.active_set;
  const double tolerance = bound_tolerance(tools, corner);
  std::vector<BoundContact> choices;
  const auto contacts = static_cast<Index>(active_set.contacts());
  for (Index j = 0; j < contacts; ++j) {
    const ContactMode mode = friction.mode(active_set, j);
    const bool touches = std::abs(corner.at.guards[j]) <= tolerance || landed == j;
    if (touches && !system.enforcement(active_set, j).two_sided) {
      std::vector<ContactMode> modes = friction.is_rough(active_set, j)
                                           ? std::vector{sticks, open, slips_forward, slips_backward}
                                           : std::vector{closed, open};
      if (mode != open) std::swap(modes[0], modes[1]);
      choices.push_back({.contact = j, .modes = std::move(modes), .touches = true});
    } else if (slips(mode) && ended == j) {
      choices.push_back({.contact = j, .modes = {sticks}, .ended = true});
    } else if (slips(mode)) {
      choices.push_back({.contact = j, .modes = {mode, sticks}});
    }
  }
  for (Index guard = contacts; guard < corner.at.guards.size(); ++guard) {
    if (!is_reached(corner.at.guards[guard], corner.at.guard_rates[guard], tolerance) && landed != guard) continue;
    const auto beyond = friction.beyond_friction_bound(active_set, guard);
    const auto known = [&](const BoundContact& choice) { return choice.contact == beyond->contact; };
    if (beyond && std::none_of(choices.begin(), choices.end(), known))
      choices.push_back({.contact = beyond->contact, .modes = {sticks, beyond->mode}});
  }
  return choices;
}

// The equations of a combination of modes at the corner with their tangent, of either sense; empty where they are
// singular.
std::optional<Continuation> tangent_with(TraceTools& tools, const Corner& corner, std::vector<ModeOfContact> modes) {
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  Continuation way{.modes = std::move(modes)};
  way.state = friction.with_modes(corner.at.state, way.modes);
  auto& [now, solver] = tools.corner_workspace;
  system.linearize(way.state, now);
  if (!all_finite(now.F)) return std::nullopt;
  if (solver.factorize(now, system.multiplier_count(way.state.active_set)) == FactorStatus::not_finite)
    return std::nullopt;
  const Metric metric = tools.metric_on(way.state.active_set, corner.lambda_scale);
  Direction across{.dx = system.transfer(corner.at.tangent.dx, corner.at.state.active_set, way.state.active_set),
                   .dlambda = corner.at.tangent.dlambda};
  Matrix columns(way.state.x.size(), 1);
  if (!solver.tangent(metric.row(across), way.direction, columns)) return std::nullopt;
  way.direction = unit(metric, std::move(way.direction));
  if (!way.direction.dx.allFinite()) return std::nullopt;
  way.slipping = friction.slipping(way.state.active_set);
  const auto slips = static_cast<Index>(way.slipping.size());
  way.relieved = Vector::Zero(slips);
  if (slips > 0 && solver.inner_is_regular()) {
    const Matrix D = slip_stiffness(solver, now);
    for (Index i = 0; i < slips; ++i) {
      const Index contact = way.slipping[static_cast<std::size_t>(i)];
      const Row slip = friction.slip_gradient(way.state, contact);
      way.relieved[i] = std::abs(D(i, i) * apply(slip, way.direction)) /
                        system.enforcement(way.state.active_set, contact).force_scale;
    }
  }
  return way;
}

int sign_of_rate(double value) { return value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }

// 1 where a contact slips on along a way, −1 where it would slip back, 0 where it does neither within the error of
// rates. A stiff body slips by less than the error of other motions; then what its slip alone relieves tells.
int sense_of_slip(const FrictionalContact& friction, const Continuation& way, Index contact, double no_motion,
                  double no_force) {
  const auto its = std::find(way.slipping.begin(), way.slipping.end(), contact) - way.slipping.begin();
  const double rate = friction.slip_rate(way.state, way.direction, contact);
  if (std::abs(rate) <= no_motion && way.relieved[its] <= no_force) return 0;
  return sign_of_rate(rate);
}

// What a way violates, and what each contact that does would do instead. A slip is none if it relieves nothing, and
// still one if its stick is known to be `overcome`: then the two are the same within the error of rates.
std::vector<ModeOfContact> violations(const TraceTools& tools, const Corner& corner,
                                      const std::vector<BoundContact>& choices, const Continuation& way,
                                      const std::set<Index>& overcome) {
  using enum ContactMode;
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  const ActiveSet& active_set = way.state.active_set;
  const auto contacts = static_cast<Index>(active_set.contacts());
  const GuardsAlong along = system.guards_along(way.state, way.direction);
  double most_motion = 0.0, most_force = 0.0;
  for (Index j = 0; j < along.rates.size(); ++j) {
    const bool is_gap = j < contacts && !active_set[static_cast<std::size_t>(j)];
    double& most = is_gap ? most_motion : most_force;
    most = std::max(most, std::abs(along.rates[j]));
  }
  for (const Index j : way.slipping)
    most_motion = std::max(most_motion, std::abs(friction.slip_rate(way.state, way.direction, j)));
  const double no_motion = rate_noise * most_motion, no_force = rate_noise * most_force;
  std::vector<ModeOfContact> found;
  for (const BoundContact& choice : choices) {
    const Index j = choice.contact;
    const ContactMode mode = friction.mode(active_set, j);
    const double rate = along.rates[j];
    if (mode == open && rate < -no_motion)
      found.push_back({.contact = j, .mode = friction.is_rough(active_set, j) ? sticks : closed});
    else if (mode != open && choice.touches && rate < -no_force)
      found.push_back({.contact = j, .mode = open});
    else if (slips(mode) && sense_of_slip(friction, way, j, no_motion, no_force) < (overcome.contains(j) ? 0 : 1))
      found.push_back({.contact = j, .mode = sticks});
  }
  const double tolerance = bound_tolerance(tools, corner);
  for (Index guard = contacts; guard < along.rates.size(); ++guard) {
    if (!is_reached(along.values[guard], along.rates[guard], tolerance) ||
        along.rates[guard] >= -tools.options.guard_tolerance * most_force)
      continue;
    const auto beyond = friction.beyond_friction_bound(active_set, guard);
    const auto has_ended = [&](const BoundContact& choice) {
      return choice.ended && choice.contact == beyond->contact;
    };
    if (beyond && std::none_of(choices.begin(), choices.end(), has_ended)) found.push_back(*beyond);
  }
  return found;
}

// −Σ T v, v the rate of slip.
double dissipation_along(const FrictionalContact& friction, const Continuation& way) {
  double power = 0.0;
  for (const Index j : way.slipping) {
    const double sense = slip_sense(friction.mode(way.state.active_set, j));
    power -= friction.friction_force(way.state, j) * sense * friction.slip_rate(way.state, way.direction, j);
  }
  return power;
}

// How the structure moves: with all contacts open, of unit length.
Direction motion_along(const TraceTools& tools, const Corner& corner, const State& state, const Direction& direction) {
  const ActiveSet open = state.active_set.all_open();
  return unit(tools.metric_on(open, corner.lambda_scale),
              {.dx = tools.system.transfer(direction.dx, state.active_set, open), .dlambda = direction.dlambda});
}

// Of ways that are one motion, that with the fewest slips.
void add_way(const Metric& open_metric, const TraceTools& tools, const Corner& corner, Continuation way,
             std::vector<Continuation>& ways) {
  const Direction motion = motion_along(tools, corner, way.state, way.direction);
  for (Continuation& known : ways) {
    const bool same = open_metric.inner(motion_along(tools, corner, known.state, known.direction), motion) > same_way;
    if (!same || way.slipping.size() == known.slipping.size()) continue;
    if (way.slipping.size() < known.slipping.size()) known = std::move(way);
    return;
  }
  ways.push_back(std::move(way));
}

void add_both_senses(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices,
                     Continuation way, std::vector<Continuation>& ways) {
  const Metric open_metric = tools.metric_on(corner.at.state.active_set.all_open(), corner.lambda_scale);
  std::set<Index> all;
  for (const BoundContact& choice : choices) all.insert(choice.contact);
  for (int sense = 0; sense < 2; ++sense) {
    if (sense == 1) way.direction = reversed(std::move(way.direction));
    if (violations(tools, corner, choices, way, all).empty()) add_way(open_metric, tools, corner, way, ways);
  }
}

std::vector<Continuation> every_way(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices) {
  std::vector<Continuation> ways;
  std::vector<std::size_t> at(choices.size(), 0);
  for (;;) {
    std::vector<ModeOfContact> modes;
    for (std::size_t i = 0; i < choices.size(); ++i)
      modes.push_back({.contact = choices[i].contact, .mode = choices[i].modes[at[i]]});
    if (auto way = tangent_with(tools, corner, std::move(modes)))
      add_both_senses(tools, corner, choices, std::move(*way), ways);
    std::size_t i = 0;
    while (i < at.size() && ++at[i] == choices[i].modes.size()) at[i++] = 0;
    if (i == at.size()) return ways;
  }
}

// Of many contacts, by block principal pivoting (Júdice and Pires 1994): all that violate the law change what they do,
// as long as they become fewer; else the last of them alone, which ends where each combination has one solution
// (Murty).
std::vector<Continuation> one_way(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices,
                                  double sense) {
  constexpr int most_blocks = 10;  // in a row, without fewer violations
  const std::size_t most_rounds = 20 * choices.size();
  std::vector<ModeOfContact> modes;
  for (const BoundContact& choice : choices) modes.push_back({.contact = choice.contact, .mode = choice.modes.front()});
  std::size_t fewest = choices.size() + 1;
  int blocks = most_blocks;
  std::set<Index> overcome;
  for (std::size_t round = 0; round < most_rounds; ++round) {
    auto way = tangent_with(tools, corner, modes);
    if (!way) return {};
    if (way->direction.dlambda * sense < 0.0) way->direction = reversed(std::move(way->direction));
    auto wrong = violations(tools, corner, choices, *way, overcome);
    if (wrong.empty()) return {std::move(*way)};
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      blocks = most_blocks;
    } else if (blocks > 0) {
      --blocks;
    } else {
      wrong = {*std::max_element(wrong.begin(), wrong.end(),
                                 [](const ModeOfContact& a, const ModeOfContact& b) { return a.contact < b.contact; })};
    }
    for (const ModeOfContact& change : wrong) {
      const auto its = std::find_if(modes.begin(), modes.end(),
                                    [&](const ModeOfContact& mode) { return mode.contact == change.contact; });
      if (its == modes.end()) return {};
      its->mode = change.mode;
      if (slips(change.mode)) overcome.insert(change.contact);
    }
  }
  return {};
}

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
  if (corner.without_progress > most_changes_here) {
    passed.end = {.reason = EndReason::no_continuation,
                  .detail = with_place("the contacts change again and again at one point; use more elements", place)};
    return passed;
  }
  if (would_hold_twice(*tools.system.friction(), corner.at.state.active_set, choices)) {
    passed.end = {.reason = EndReason::not_modelled,
                  .detail = with_place("two frictions at one end are not determined by equilibrium", place)};
    return passed;
  }
  for (const BoundContact& choice : choices) {
    if (!choice.touches) continue;
    std::string why = tools.system.friction()->why_not_modelled(corner.at.state.active_set, choice.contact);
    if (why.empty()) continue;
    passed.end = {.reason = EndReason::not_modelled, .detail = with_place(std::move(why), place)};
    return passed;
  }
  const double sense = corner.at.tangent.dlambda < 0.0 ? -1.0 : 1.0;
  std::size_t combined = 1;
  for (const BoundContact& choice : choices) combined = std::min(combined * choice.modes.size(), most_combined + 1);
  bool all_known = choices.size() <= few_contacts;
  std::vector<Continuation> ways;
  if (!all_known) ways = one_way(tools, corner, choices, sense);
  if (ways.empty() && combined <= most_combined) {
    ways = every_way(tools, corner, choices);
    all_known = true;
  }
  if (ways.empty() && !all_known) ways = one_way(tools, corner, choices, -sense);

  const Direction incoming = motion_along(tools, corner, corner.at.state, corner.at.tangent);
  const Metric open_metric = tools.metric_on(corner.at.state.active_set.all_open(), corner.lambda_scale);
  const auto cosine = [&](const Continuation& way) {
    return open_metric.inner(motion_along(tools, corner, way.state, way.direction), incoming);
  };
  std::erase_if(ways, [&](const Continuation& way) {
    return (!corner.begins_branch && cosine(way) < -same_way) || unloads(way, choices, sense);
  });
  const std::optional<Index> before =
      corner.at.negative_eigenvalues ? corner.at.negative_eigenvalues : corner.before.unstable;
  const auto oriented = corner.begins_branch ? std::nullopt : orientation(before, corner.at.tangent);
  const auto turns_over = [&](const Continuation& way) {
    const auto turned = orientation(way.unstable, way.direction);
    return oriented && turned && *oriented != *turned;
  };
  for (Continuation& way : ways) way.unstable = tools.counter.negative_on(way.state);
  // A stick has the tangent of the slip that ends, and leaves its bound by −½ D v′ s² (18.4a): D < 0 turns over.
  if (ended) std::erase_if(ways, [&](const Continuation& way) { return cosine(way) > same_way && turns_over(way); });
  const auto turns = [&](const Continuation& way) { return way.direction.dlambda * sense < 0.0; };
  if (corner.begins_branch && !std::all_of(ways.begin(), ways.end(), turns)) std::erase_if(ways, turns);
  if (ways.empty() && !all_known) {
    passed.end = {.reason = EndReason::no_continuation,
                  .detail = with_place("of " + std::to_string(choices.size()) +
                                           " contacts that may stick, slip or open here no motion was found in which "
                                           "friction opposes slip",
                                       place)};
    return passed;
  }
  if (ways.empty()) {
    passed.end = {.reason = EndReason::jammed,
                  .detail = with_place("no motion in which friction opposes slip leads on: the load can go no further "
                                       "in this sense; let a stage drive back, or lower the friction",
                                       place)};
    return passed;
  }
  std::optional<FrictionRank> best;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    Continuation& way = ways[i];
    way.dissipation = dissipation_along(*tools.system.friction(), way);
    const bool goes_on = way.direction.dlambda * sense > 0.0;
    const FrictionRank rank{.turns_over = turns_over(way),
                            .kind = !goes_on                   ? 2
                                    : way.unstable == Index{0} ? 0
                                                               : 1,
                            .unstable = way.unstable.value_or(std::numeric_limits<Index>::max()),
                            .less_dissipation = -way.dissipation,
                            .backward = -cosine(way)};
    if (best && !(rank < *best)) continue;
    best = rank;
    chosen = i;
  }
  const Continuation& taken = ways[chosen];
  const Metric metric = tools.metric_on(taken.state.active_set, corner.lambda_scale);
  // Bounds that were reached together but for an error are met by all from here on.
  CorrectorResult result = held_at_corner(tools, corner, metric, taken.state, taken.direction);
  if (!result.converged()) {
    passed.end = {.reason = EndReason::singular, .detail = with_place(nothing_behind_change, place)};
    return passed;
  }
  PathPoint at = path_point(tools.system, metric, std::move(result), taken.direction);
  decide_count(tools, at);
  at.arc = corner.at.arc;
  at.iterations = corner.at.iterations;
  at.count = tools.counter.count(at.state, at.negative_eigenvalues);
  if (taken.unstable) at.count.unstable = taken.unstable;  // contacts that touch without a force hold along the way
  Event event{.state = at.state,
              .arc = at.arc,
              .residual = corner.at.residual,
              .lambda_uncertainty = 0.0,
              .unstable_before = corner.before.unstable,
              .unstable_after = at.count.unstable,
              .all_ways_known = all_known};
  for (const Continuation& way : ways)
    event.friction_ways.push_back({.modes = way.modes,
                                   .lambda_sense = sign_of_rate(way.direction.dlambda),
                                   .dissipation = way.dissipation,
                                   .unstable = way.unstable,
                                   .taken = &way == &taken});
  passed.events = events_between(tools, corner, at, event);
  for (const Event& change : passed.events)
    event.guards.insert(event.guards.end(), change.guards.begin(), change.guards.end());
  passed.signs = signs_at(tools.detectors, at);
  if (!corner.begins_branch) add_turns(tools, corner.signs, passed.signs, event, passed.events);
  passed.at = std::move(at);
  return passed;
}

}  // namespace arcwall
