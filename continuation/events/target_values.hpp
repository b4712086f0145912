#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/trace_options.hpp"

namespace arcwall {

/// The quantity less the target value.
inline double excess(const TargetValue& target, const State& state) {
  return target.quantity->value(state) - target.value;
}

/// Differences below this are round-off: the value is met. `v0`, `v1`: excesses at both ends of a stretch, which give
/// the scale of a value that is zero. Of another value a state meets it or not, whatever lies beyond.
inline double excess_noise(const TargetValue& target, double v0, double v1) {
  const double scale = target.value != 0.0 ? std::abs(target.value) : std::max(std::abs(v0), std::abs(v1));
  return std::max(1e-11 * scale, target.roundoff);
}

/// Whether the value lies between two states, or at the second one; one that is met at the first does not count.
inline bool lies_between(const TargetValue& target, const State& first, const State& second) {
  const double v0 = excess(target, first), v1 = excess(target, second), noise = excess_noise(target, v0, v1);
  return std::abs(v0) > noise && (std::abs(v1) <= noise || v0 * v1 < 0.0);
}

/// Whether the value is met at the first of two states and not at the second one.
inline bool is_left(const TargetValue& target, const State& first, const State& second) {
  const double v0 = excess(target, first), v1 = excess(target, second), noise = excess_noise(target, v0, v1);
  return std::abs(v0) <= noise && std::abs(v1) > noise;
}

/// The event at a point at which the value is passed. It is solved for: what is uncertain is round-off.
inline Event value_crossing(const TargetValue& target, const PathPoint& at, std::optional<Index> unstable_before,
                            std::optional<Index> unstable_after) {
  return {.kind = EventKind::value_crossing,
          .label = target.event,
          .state = at.state,
          .arc = at.arc,
          .residual = at.residual,
          .lambda_uncertainty = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(at.state.lambda),
          .unstable_before = unstable_before,
          .unstable_after = unstable_after,
          .value = target.value};
}

}  // namespace arcwall
