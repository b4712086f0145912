#pragma once

#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "contact/sliding/validity_bound.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// What lies behind a state where the span behind a tracked point has become short: a line gathers to a point, or the
/// gap between two parts on an obstacle closes and they join. Spans of the same kind that do so together go with it.
std::vector<Transition> span_vanishes(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                                      const Arrival& arrival);

/// What may lie there instead: a short part of which one half is pressed and one arches off gathers to a point as a
/// whole; and where the wall bends away from the body between a pressed part and a point beside it, so that no part
/// lies across, the point and the part's edge meet. `forward`: of the path.
std::vector<Transition> neighbours_vanish(const SlidingSetting& setting, const SlidingState& at,
                                          const Direction& forward, std::size_t point);

/// What lies behind a state where the free span between a plane of symmetry at an end and the pressed part behind a
/// point becomes short: the part reaches the plane where its pressure there, or the load that pulled it off, vanishes.
Transition zone_joins_at_plane(const SlidingSetting& setting, const SlidingState& at, std::size_t point, bool last);

}  // namespace arcwall::sliding
