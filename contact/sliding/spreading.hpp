#pragma once

#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "contact/sliding/validity_bound.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// What may lie behind a state where closed points lose their curvature gap, the likeliest first: each of those
/// that do so together becomes two, between which the body lies on the obstacle or arches off it. All such points of an
/// equilibrium with straight obstacles become lines together; of several flat ones only the sum of the lengths is
/// determined, and what lies behind is a continuum of equilibria. Where two neighbours lose their gap because nothing
/// bends the straight span between them any more, it comes to lie.
std::vector<Transition> zones_or_arches_from_points(const SlidingSetting& setting, const SlidingState& at,
                                                    const Arrival& arrival);

}  // namespace arcwall::sliding
