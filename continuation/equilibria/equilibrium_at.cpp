#include "continuation/equilibria/equilibrium_at.hpp"

#include "continuation/path_tolerances.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

std::optional<CountedState> equilibrium_at_lambda(const System& system, const State& guess,
                                                  const TraceOptions& options) {
  constexpr double distance = 0.1;  // of a generous guess [path metric]
  constexpr double slack = 1e-8;    // of guards
  TraceTools tools(system, options);
  const Metric metric = tools.metric_on(guess.active_set, 1.0);  // λ stays
  const ParameterValue lambda;
  const Direction along{.dx = Vector::Zero(guess.x.size()), .dlambda = 1.0};
  const CorrectorResult found =
      tools.corrector.correct_patiently(guess, ValueConstraint(lambda, guess.lambda), metric, along, distance);
  if (!found.converged()) return std::nullopt;
  if (system.check({.from = found.state, .to = found.state}).fault != StepVerdict::Fault::none) return std::nullopt;
  if ((system.guards(found.state).array() < -slack).any()) return std::nullopt;
  if (system.penetrated_place(found.state, -penetration_tolerance)) return std::nullopt;
  return CountedState{.state = found.state, .count = tools.counter.count(found.state, found.negative)};
}

}  // namespace arcwall
