#include "continuation/corners/friction_ways.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "continuation/path_tolerances.hpp"
#include "core/algebra/slip_stiffness.hpp"

namespace arcwall {

namespace {

constexpr double rate_noise = 1e-10;         // error of rates, relative to the greatest of their kind
constexpr std::size_t few_contacts = 6;      // whose combinations are all tried
constexpr std::size_t most_combined = 4096;  // combinations of modes that are tried where nothing else is found

double bound_tolerance(const TraceTools& tools, const Corner& corner) {
  return std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
}

// Whether a guard is zero, or nearly so and zero at a place along the path that coincides with the corner: symmetry
// lets bounds be reached together, up to round-off.
bool is_reached(double guard, double rate, double tolerance) {
  return guard <= tolerance || (guard <= coincidence_tolerance && guard <= -coincidence_tolerance * rate);
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

}  // namespace

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

Direction motion_along(const TraceTools& tools, const Corner& corner, const State& state, const Direction& direction) {
  const ActiveSet open = state.active_set.all_open();
  return unit(tools.metric_on(open, corner.lambda_scale),
              {.dx = tools.system.transfer(direction.dx, state.active_set, open), .dlambda = direction.dlambda});
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

WaysOn ways_on(TraceTools& tools, const Corner& corner, const std::vector<BoundContact>& choices, double sense) {
  std::size_t combined = 1;
  for (const BoundContact& choice : choices) combined = std::min(combined * choice.modes.size(), most_combined + 1);
  WaysOn found{.all_known = choices.size() <= few_contacts};
  if (!found.all_known) found.ways = one_way(tools, corner, choices, sense);
  if (found.ways.empty() && combined <= most_combined)
    found = {.ways = every_way(tools, corner, choices), .all_known = true};
  if (found.ways.empty() && !found.all_known) found.ways = one_way(tools, corner, choices, -sense);
  return found;
}

}  // namespace arcwall
