#include "continuation/equilibria/deflated_newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/algebra/assembly.hpp"
#include "core/turns.hpp"

namespace arcwall {

namespace {

// All lengths in the path metric, without multipliers.
constexpr int newton_iterations = 100;
constexpr int changes_together = 25;         // iterations in which all contacts that are wrong change; then one does
constexpr double deflation_length = 0.1;     // σ: how far the drive off a known equilibrium reaches
constexpr double longest_newton_step = 0.1;  // farther off the linearised equations say little
constexpr double last_newton_step = 1e-11;   // of Newton's last step
constexpr double is_known_one = 1e-6;        // of equilibria
constexpr double touching = 1e-8;            // [scale of guards]
constexpr double guard_violated = 1e-10;     // [scale of guards]
constexpr double far_from_guess = 10.0;      // of the guess

double weighted_square(const Eigen::Ref<const Vector>& weights, const Eigen::Ref<const Vector>& dx) {
  return (weights.array() * dx.array().square()).sum();
}

// The contacts to be changed: all that are wrong, later the worst alone. Empty if none is.
std::optional<ActiveSet> changed_active_set(const UnilateralSystem& system, const State& state, bool all) {
  const Vector guards = system.guards(state);
  ActiveSet active_set = state.active_set;
  std::optional<Index> worst;
  const auto toggle = [&](Index j) {
    std::uint8_t& closed = active_set[static_cast<std::size_t>(j)];
    closed = closed == 0 ? 1 : 0;
  };
  for (Index j = 0; j < static_cast<Index>(active_set.size()); ++j) {
    if (!(guards[j] < -guard_violated) || system.enforcement(state.active_set, j).two_sided) continue;
    if (!worst || guards[j] < guards[*worst]) worst = j;
    if (all) toggle(j);
  }
  if (!worst) return std::nullopt;
  if (!all) toggle(*worst);
  return active_set;
}

// What touches is closed to begin with: the image of an equilibrium is one with its contacts alone.
State with_touching(const UnilateralSystem& system, const State& state) {
  const Vector guards = system.guards(state);
  ActiveSet active_set = state.active_set;
  for (std::size_t j = 0; j < active_set.size(); ++j)
    if (std::abs(guards[static_cast<Index>(j)]) <= touching) active_set[j] = 1;
  return system.with_active_set(state, active_set);
}

}  // namespace

DeflatedResult DeflatedNewton::from(State guess) {
  const State start = guess;
  const bool follow = contacts_ == Contacts::follow;
  DeflatedResult result{.state = follow ? with_touching(system_, guess) : std::move(guess)};
  State& state = result.state;
  for (; result.iterations < newton_iterations; ++result.iterations) {
    std::optional<ActiveSet> active_set;
    if (follow) active_set = changed_active_set(system_, state, result.iterations < changes_together);
    if (active_set) state = system_.with_active_set(state, *active_set);
    Vector step;
    if (!newton_step(state, step)) return result;
    const Vector weights = system_.weights(state.active_set);
    const double length = std::sqrt(weighted_square(weights, step));
    if (!active_set && length <= last_newton_step) {
      state.x += step;
      result.end = is_known(state) ? DeflatedEnd::known : DeflatedEnd::arrived;
      return result;
    }
    const double by = factor(state, step);
    state.x +=
        (std::abs(by) * length > longest_newton_step ? std::copysign(longest_newton_step / length, by) : by) * step;
    const Index n = weights.size() - system_.multiplier_count(state.active_set);
    if (!all_finite(state.x) ||
        weighted_square(weights.head(n), state.x.head(n) - start.x.head(n)) > far_from_guess * far_from_guess)
      return result;
  }
  return result;
}

std::optional<State> DeflatedNewton::beside(const State& guess) {
  constexpr int iterations = 5;
  State state = contacts_ == Contacts::follow ? with_touching(system_, guess) : guess;
  for (int i = 0; i < iterations; ++i) {
    Vector step;
    if (!newton_step(state, step)) return std::nullopt;
    const double length = std::sqrt(weighted_square(system_.weights(state.active_set), step));
    if (length > is_known_one) return std::nullopt;
    state.x += step;
    if (length <= last_newton_step)
      return changed_active_set(system_, state, true) ? std::nullopt : std::optional(state);
  }
  return std::nullopt;
}

// J δ = −F
bool DeflatedNewton::newton_step(const State& state, Vector& step) {
  if (here_.linearize_at(state) != FactorStatus::ok) return false;
  Matrix solution = -here_.equations().F;
  if (!here_.solver().solve_inner(solution)) return false;
  step = solution.col(0);
  return all_finite(step);
}

// 1/(1 − s), s = ∇(log m) · step
double DeflatedNewton::factor(const State& state, const Vector& step) const {
  constexpr double least = 1e-3;  // of |1 − s|
  const StateMetric metric = system_.metric(state.active_set);
  double s = 0.0;
  for (const Vector& known : known_) {
    const Index n = known.size();
    const Vector off = state.x.head(n) - turned_towards(state.x, known, metric.turning_sets);
    const double r2 = std::max(weighted_square(metric.weights.head(n), off), 1e-300);
    const double along = (metric.weights.head(n).array() * off.array() * step.head(n).array()).sum();
    const double ratio = deflation_length * deflation_length / r2;
    s -= 2.0 * along / r2 * ratio / (1.0 + ratio);
  }
  const double divisor = 1.0 - s;
  return 1.0 / (std::abs(divisor) < least ? std::copysign(least, divisor) : divisor);
}

bool DeflatedNewton::is_known(const State& state) const {
  const StateMetric metric = system_.metric(state.active_set);
  return std::any_of(known_.begin(), known_.end(), [&](const Vector& known) {
    const Index n = known.size();
    const Vector off = state.x.head(n) - turned_towards(state.x, known, metric.turning_sets);
    return weighted_square(metric.weights.head(n), off) <= is_known_one * is_known_one;
  });
}

}  // namespace arcwall
