#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "continuation/event_curves/event_derivative.hpp"
#include "core/algebra/bordered_solver.hpp"
#include "core/central_difference.hpp"

/// Differences by κ between samples, and along the path.
namespace arcwall {

/// Of differences of J along a direction: the longest h [path metric], and how often it is halved for the best.
inline constexpr double longest_difference = 6.4e-2;
inline constexpr int difference_halvings = 13;

inline EventDerivative no_derivative(std::string why) { return {.value = std::nullopt, .why_none = std::move(why)}; }

/// J k_x + F_λ k_λ at a state.
inline Vector directional(const Equations& system, const State& state, const Direction& k, Linearization& workspace) {
  system.linearize(state, workspace);
  return product(workspace, k.dx).col(0) + k.dlambda * workspace.F_lambda;
}

/// dQ/dκ of a quantity of a sample's system and a state, along states that move by d with κ; `coarse`: of lower order.
template <typename Function>
auto rate_along(const std::vector<SystemSample>& samples, const Direction& d, const Function& quantity,
                bool coarse = false) {
  std::optional<std::decay_t<decltype(quantity(samples.front(), samples.front().state))>> sum;
  for (const SystemSample& sample : samples) {
    const double weight = coarse ? sample.coarse_weight : sample.weight;
    auto part = quantity(sample, moved(sample.state, d, sample.offset));
    part *= weight;
    if (sum)
      *sum += part;
    else
      sum = std::move(part);
  }
  return *sum;
}

inline Vector residual_rate(const std::vector<SystemSample>& samples, const Direction& d, bool coarse = false) {
  const auto residual = [](const SystemSample& sample, const State& state) {
    Vector F(state.x.size());
    sample.system->residual(state, F);
    return F;
  };
  return rate_along(samples, d, residual, coarse);
}

/// Σ weight f(offset · h)/h, at states along d
template <typename Function>
auto difference_along(const Metric& metric, const State& state, const Direction& d, double part, const Function& f) {
  // Forces alone have no length, and equations are linear in them.
  const double length = metric.norm(d), h = length > 0.0 ? part / length : 1.0 / d.dx.cwiseAbs().maxCoeff();
  std::decay_t<decltype(f(state))> sum = f(state);
  sum *= 0.0;
  for (const DifferencePlace& place : central_difference)
    sum += place.weight / h * f(moved(state, d, place.offset * h));
  return sum;
}

/// The length of a step of the number.
inline double step_of(const std::vector<SystemSample>& samples) {
  double greatest = 0.0;
  for (const SystemSample& sample : samples) greatest = std::max(greatest, std::abs(sample.weight));
  return 1.0 / greatest;
}

/// Long steps have an error of their own, where contacts slide over bends or elements are slender, short ones that of
/// round-off: of the three steps in a row whose derivatives differ least the longest one is taken. Two may agree by
/// chance.
template <typename Function>
SettledRate with_best_step(double longest, int halvings, const Function& derivative) {
  SettledRate best{.value = std::nan(""), .off = infinity};
  double longer = derivative(longest), middle = derivative(0.5 * longest);
  for (int i = 2; i <= halvings; ++i) {
    const double shorter = derivative(std::ldexp(longest, -i));
    const double off = std::max(std::abs(middle - longer), std::abs(shorter - middle));
    if (off < best.off) best = {.value = longer, .off = off};
    longer = std::exchange(middle, shorter);
  }
  return best;
}

}  // namespace arcwall
