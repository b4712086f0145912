#include "continuation/corners/friction_ways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/corners/contact_rates.hpp"
#include "continuation/path_tolerances.hpp"
#include "core/algebra/slip_stiffness.hpp"

namespace arcwall {

namespace {

constexpr double rate_noise = 1e-10;     // error of rates, relative to the greatest of their kind
constexpr std::size_t few_contacts = 6;  // whose combinations are all tried

double bound_tolerance(const TraceTools& tools, const Corner& corner) {
  return std::max(tools.options.guard_tolerance, 2.0 * corner.slack);
}

// Whether a guard is zero, or nearly so and zero at a place along the path that coincides with the corner: symmetry
// lets bounds be reached together, up to round-off.
bool is_reached(double guard, double rate, double tolerance) {
  return guard <= tolerance || (guard <= coincidence_tolerance && guard <= -coincidence_tolerance * rate);
}

// Linearizes and factorizes the equations at a state of the corner; false where they are not finite.
bool is_factorized(TraceTools& tools, const State& state) {
  auto& [now, solver] = tools.corner_workspace;
  tools.system.linearize(state, now);
  return all_finite(now.F) &&
         solver.factorize(now, tools.system.multiplier_count(state.active_set)) != FactorStatus::not_finite;
}

// The equations of a combination of modes at the corner with their tangent, of either sense; empty where they are
// singular.
std::optional<Continuation> tangent_with(TraceTools& tools, const Corner& corner, std::vector<ModeOfContact> modes) {
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  Continuation way{.modes = std::move(modes)};
  way.state = friction.with_modes(corner.at.state, way.modes);
  if (!is_factorized(tools, way.state)) return std::nullopt;
  auto& [now, solver] = tools.corner_workspace;
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

// How fast guards change along a way, and the errors of these rates.
struct RatesAlong {
  GuardsAlong guards{};
  double most_force = 0.0, no_motion = 0.0, no_force = 0.0;

  RatesAlong(const System& system, const Continuation& way) : guards(system.guards_along(way.state, way.direction)) {
    const ActiveSet& active_set = way.state.active_set;
    double most_motion = 0.0;
    for (Index j = 0; j < guards.rates.size(); ++j) {
      const bool is_gap = j < static_cast<Index>(active_set.contacts()) && !active_set[static_cast<std::size_t>(j)];
      double& most = is_gap ? most_motion : most_force;
      most = std::max(most, std::abs(guards.rates[j]));
    }
    for (const Index j : way.slipping)
      most_motion = std::max(most_motion, std::abs(system.friction()->slip_rate(way.state, way.direction, j)));
    no_motion = rate_noise * most_motion;
    no_force = rate_noise * most_force;
  }
};

// Whether contacts neither pull nor enter, and slip as their friction lets them. A slip that relieves nothing is as
// good as a stick.
bool fulfils_law(const FrictionalContact& friction, const std::vector<BoundContact>& choices, const Continuation& way,
                 const RatesAlong& along) {
  return std::none_of(choices.begin(), choices.end(), [&](const BoundContact& choice) {
    const Index j = choice.contact;
    const ContactMode mode = friction.mode(way.state.active_set, j);
    const double rate = along.guards.rates[j];
    return (mode != ContactMode::open && choice.touches && rate < -along.no_force) ||
           (mode == ContactMode::open && rate < -along.no_motion) ||
           (slips(mode) && sense_of_slip(friction, way, j, along.no_motion, along.no_force) < 0);
  });
}

// What contacts that stick do beyond the bounds which a way passes at once. A stick that ends a slip stays at its own.
std::vector<ModeOfContact> passed_bounds(const TraceTools& tools, const Corner& corner,
                                         const std::vector<BoundContact>& choices, const Continuation& way,
                                         const RatesAlong& along) {
  const FrictionalContact& friction = *tools.system.friction();
  const ActiveSet& active_set = way.state.active_set;
  const double tolerance = bound_tolerance(tools, corner), falls = tools.options.guard_tolerance * along.most_force;
  std::vector<ModeOfContact> passed;
  for (auto guard = static_cast<Index>(active_set.contacts()); guard < along.guards.rates.size(); ++guard) {
    const double rate = along.guards.rates[guard];
    if (rate >= -falls || !is_reached(along.guards.values[guard], rate, tolerance)) continue;
    const auto beyond = friction.beyond_friction_bound(active_set, guard);
    const auto has_ended = [&](const BoundContact& choice) {
      return choice.ended && choice.contact == beyond->contact;
    };
    if (beyond && std::none_of(choices.begin(), choices.end(), has_ended)) passed.push_back(*beyond);
  }
  return passed;
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
  for (int sense = 0; sense < 2; ++sense) {
    if (sense == 1) way.direction = reversed(std::move(way.direction));
    const RatesAlong along(tools.system, way);
    if (fulfils_law(*tools.system.friction(), choices, way, along) &&
        passed_bounds(tools, corner, choices, way, along).empty())
      add_way(open_metric, tools, corner, way, ways);
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

bool is_among(const std::vector<BoundContact>& choices, Index contact) {
  return std::any_of(choices.begin(), choices.end(),
                     [contact](const BoundContact& choice) { return choice.contact == contact; });
}

// A contact as the problem of rates has it, which begins with what it did before; where a branch begins one that
// touches is closed at first, by which others answer to it from the start.
ContactAtBound at_bound(const FrictionalContact& friction, const Corner& corner, const ActiveSet& closed,
                        const BoundContact& choice) {
  const auto slip = std::find_if(choice.modes.begin(), choice.modes.end(), slips);
  const ActiveSet& first = choice.touches && corner.begins_branch ? closed : corner.at.state.active_set;
  return {.mode = choice.ended ? ContactMode::sticks : friction.mode(first, choice.contact),
          .friction = friction.is_rough(closed, choice.contact) ? friction.coefficient(closed, choice.contact) : 0.0,
          .touches = choice.touches,
          .slip_sense = choice.touches || slip == choice.modes.end() ? 0.0 : slip_sense(*slip)};
}

// How contacts at bounds answer to gaps, slips and λ, from the equations in which all of them are closed and stick.
// Empty where these are singular.
std::optional<ContactRates> contact_rates(TraceTools& tools, const Corner& corner,
                                          const std::vector<BoundContact>& choices, double sense) {
  const System& system = tools.system;
  const FrictionalContact& friction = *system.friction();
  std::vector<ModeOfContact> modes;
  for (const BoundContact& choice : choices)
    modes.push_back({.contact = choice.contact,
                     .mode = friction.is_rough(corner.at.state.active_set, choice.contact) ? ContactMode::sticks
                                                                                           : ContactMode::closed});
  const State closed = friction.with_modes(corner.at.state, modes);
  auto& [now, solver] = tools.corner_workspace;
  if (!is_factorized(tools, closed) || !solver.inner_is_regular()) return std::nullopt;
  const auto k = static_cast<Index>(choices.size());
  ContactRates rates{.A = Matrix::Zero(2 * k, 2 * k), .b = Vector::Zero(2 * k)};
  std::vector<Index> force, tangential(choices.size(), -1);
  Matrix answers = Matrix::Zero(closed.x.size(), 2 * k + 1);
  answers.col(2 * k) = -sense * now.F_lambda;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Index j = choices[i].contact, column = static_cast<Index>(i);
    rates.contacts.push_back(at_bound(friction, corner, closed.active_set, choices[i]));
    const auto p = system.enforcement(closed.active_set, j).multiplier;
    if (!p) return std::nullopt;
    force.push_back(*p);
    answers(*p, column) = -1.0;  // its equation is −g
    if (!friction.is_rough(closed.active_set, j)) continue;
    tangential[i] = friction.friction_index(closed.active_set, j).value();
    const FrictionalContact::HeldPlace held = friction.held_place(closed.active_set, j);
    answers(held.equation, k + column) = held.by_slip;
  }
  if (!solver.solve_inner(answers)) return std::nullopt;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const auto row = static_cast<Index>(i);
    const auto add = [&](Index to, Index from) {
      rates.A.row(to) = answers.row(from).head(2 * k);
      rates.b[to] = answers(from, 2 * k);
    };
    add(row, force[i]);
    if (tangential[i] >= 0) add(k + row, tangential[i]);
  }
  return rates;
}

// The sense of a way, first that of λ given, in which it fulfils the law, with the bounds of other contacts that it
// passes at once. Empty where it does in neither.
std::optional<std::vector<ModeOfContact>> oriented(const TraceTools& tools, const Corner& corner,
                                                   const std::vector<BoundContact>& choices, double sense,
                                                   Continuation& way) {
  if (way.direction.dlambda * sense < 0.0) way.direction = reversed(std::move(way.direction));
  for (int tried = 0; tried < 2; ++tried) {
    const RatesAlong along(tools.system, way);
    auto passed = passed_bounds(tools, corner, choices, way, along);
    const auto is_known = [&](const ModeOfContact& beyond) { return is_among(choices, beyond.contact); };
    if (fulfils_law(*tools.system.friction(), choices, way, along) &&
        std::none_of(passed.begin(), passed.end(), is_known))
      return passed;
    way.direction = reversed(std::move(way.direction));
  }
  return std::nullopt;
}

// Of many contacts one combination, by pivoting. Contacts whose bounds are passed at once along it belong to the
// corner, too.
std::vector<Continuation> one_way(TraceTools& tools, const Corner& corner, std::vector<BoundContact> choices,
                                  double sense) {
  for (;;) {
    const auto rates = contact_rates(tools, corner, choices, sense);
    const auto found = rates ? pivoted_modes(*rates) : std::nullopt;
    if (!found) return {};
    std::vector<ModeOfContact> modes;
    for (std::size_t i = 0; i < choices.size(); ++i)
      modes.push_back({.contact = choices[i].contact, .mode = (*found)[i]});
    auto way = tangent_with(tools, corner, std::move(modes));
    const auto passed = way ? oriented(tools, corner, choices, sense, *way) : std::nullopt;
    if (!passed) return {};
    if (passed->empty()) return {std::move(*way)};
    for (const ModeOfContact& beyond : *passed)
      choices.push_back({.contact = beyond.contact, .modes = {ContactMode::sticks, beyond.mode}});
  }
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
    if (beyond && !is_among(choices, beyond->contact))
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
  if (choices.size() <= few_contacts) return {.ways = every_way(tools, corner, choices), .all_known = true};
  return {.ways = one_way(tools, corner, choices, sense)};
}

}  // namespace arcwall
