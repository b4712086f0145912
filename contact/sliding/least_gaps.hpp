#pragma once

#include <optional>
#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"

namespace arcwall::sliding {

/// A place inside an element where the gap to an obstacle is least.
struct LeastGap {
  std::size_t obstacle = 0;
  MaterialPoint at{};
  double gap = 0.0;  ///< [length]
};

/// The least gaps below `margin` (in the scale of the guards) that no guard watches, the deepest first: beside contact
/// points, and where the body lies on the obstacle, guards say all.
std::vector<LeastGap> unwatched_gaps(const SlidingSetting& setting, const SlidingState& at, double margin);

/// All of them, whether a guard watches them or not.
std::vector<LeastGap> least_gaps(const SlidingSetting& setting, const SlidingState& at);

/// Of all least gaps on the same strand and obstacle the one nearest another.
std::optional<LeastGap> nearest_least_gap(const SlidingSetting& setting, const SlidingState& at, const LeastGap& other);

/// Whether a strand would have to go through an obstacle from one state to the other: it sweeps over the core of a
/// closed one, or one of its ends passes through.
bool passes_through(const SlidingSetting& setting, const SlidingState& from, const SlidingState& to);

/// Whether a place of a strand comes from where an obstacle has no face, beyond its end, to where it is inside.
bool comes_behind_an_end(const SlidingSetting& setting, const SlidingState& from, const SlidingState& to);

/// The least gap at `places` points of each element and where it faces the knots of a surface, against every obstacle
/// [length].
double sampled_least_gap(const SlidingSetting& setting, const SlidingState& at, int places);

}  // namespace arcwall::sliding
