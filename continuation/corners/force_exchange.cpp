#include "continuation/corners/force_exchange.hpp"

#include <utility>

#include "continuation/path_tolerances.hpp"

namespace arcwall {

std::optional<ForceExchange> exchange_forces(TraceTools& tools, const State& state, Index closing,
                                             double lambda_scale) {
  const System& system = tools.system;
  const auto j = static_cast<std::size_t>(closing);
  if (j >= state.active_set.contacts() || state.active_set[j]) return std::nullopt;
  auto& [now, solver] = tools.corner_workspace;
  system.linearize(state, now);
  if (solver.factorize(now, system.multiplier_count(state.active_set)) != FactorStatus::ok) return std::nullopt;
  Matrix rates = system.unit_force(state, closing);
  if (!solver.solve_inner(rates)) return std::nullopt;

  std::optional<Index> without_force;
  double force = 0.0;  // of the new contact, in the scale of guards
  for (Index i = 0; i < static_cast<Index>(state.active_set.contacts()); ++i) {
    const Enforcement how = system.enforcement(state.active_set, i);
    if (!how.multiplier || how.two_sided || rates(*how.multiplier, 0) >= 0.0) continue;
    const Index k = *how.multiplier;
    const double vanishes_at = state.x[k] / -rates(k, 0);
    if (without_force && vanishes_at >= force) continue;
    without_force = i;
    force = vanishes_at;
  }
  if (!without_force) return std::nullopt;
  const Metric metric = tools.metric_on(state.active_set, lambda_scale);
  if (metric.norm({.dx = force * rates.col(0), .dlambda = 0.0}) > coincidence_tolerance) return std::nullopt;

  State changed = state;
  changed.x += force * rates.col(0);
  ActiveSet with_new = state.active_set;
  with_new[j] = 1;
  ForceExchange exchange{.state = system.with_active_set(changed, with_new), .without_force = *without_force};
  if (const Enforcement how = system.enforcement(with_new, closing); how.multiplier)
    exchange.state.x[*how.multiplier] = force * how.force_scale;
  if (const auto k = system.enforcement(with_new, *without_force).multiplier) exchange.state.x[*k] = 0.0;
  return exchange;
}

}  // namespace arcwall
