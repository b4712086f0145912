#pragma once

#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// What may lie behind a state where the pressure on pressed parts vanishes, the likeliest first: at each node within
/// `tolerance` of that, of neighbours the one with the least pressure, the part becomes two with a free span between
/// them; at its end, one and a point contact. Free spans are tried in several lengths.
std::vector<Transition> parts_lift_off(const SlidingSetting& setting, const SlidingState& at, double tolerance);

}  // namespace arcwall::sliding
