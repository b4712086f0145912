#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/equations.hpp"

namespace arcwall {

/// x with other multiples of 2π of the rotations that do not count them, as near to `other` as can be: the same state.
/// `sets` as StateMetric has them; x and `other` may end before or behind them.
inline Vector turned_towards(const Eigen::Ref<const Vector>& other, Vector x, const std::vector<Index>& sets) {
  if (sets.empty()) return x;
  const auto common = static_cast<std::size_t>(std::min({x.size(), other.size(), static_cast<Index>(sets.size())}));
  struct Offset {
    double sum = 0.0;
    Index count = 0;
  };
  std::vector<Offset> offsets(static_cast<std::size_t>(*std::max_element(sets.begin(), sets.end()) + 1));
  for (std::size_t i = 0; i < common; ++i) {
    if (sets[i] < 0) continue;
    Offset& offset = offsets[static_cast<std::size_t>(sets[i])];
    offset.sum += other[static_cast<Index>(i)] - x[static_cast<Index>(i)];
    ++offset.count;
  }
  for (std::size_t i = 0; i < common; ++i) {
    if (sets[i] < 0) continue;
    const Offset& offset = offsets[static_cast<std::size_t>(sets[i])];
    if (const double turns = std::round(offset.sum / (2.0 * pi * double(offset.count))); turns != 0.0)
      x[static_cast<Index>(i)] += 2.0 * pi * turns;
  }
  return x;
}

/// The same of two states on one active set.
inline State turned_towards(const Equations& system, const State& other, State state) {
  state.x = turned_towards(other.x, std::move(state.x), system.metric(state.active_set).turning_sets);
  return state;
}

}  // namespace arcwall
