#pragma once

#include <optional>
#include <vector>

#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "contact/sliding/validity_bound.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// What may lie behind a state where the pressure on pressed parts vanishes, the likeliest first: at each node where it
/// does, of neighbours the one with the least pressure, the part becomes two with a free span between them; at its end,
/// one and a point contact. Free spans are tried in several lengths. A strand that lies on its obstacle from end to end
/// leaves it where its pressure vanishes all along.
std::vector<Transition> parts_lift_off(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival);

/// The same at the edge of a part where the wall ahead would pull: the part ends beyond that place, and the edge stays
/// as a point contact.
std::vector<Transition> edge_lifts_off(const SlidingSetting& setting, const SlidingState& at, std::size_t edge,
                                       const Arrival& arrival);

/// The same where a point load inside a pressed part pulls it off: the free span has the load in its middle.
std::vector<Transition> load_lifts_off(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load,
                                       const Arrival& arrival);

/// Of strands that lie on obstacles from end to end those leave theirs on which nothing presses any more: the same
/// state, without contact. Empty where there is none.
std::optional<Transition> strands_leave(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival);

/// What lies behind a state where the load at an end on a plane of symmetry, up to which a part is pressed, begins to
/// pull.
std::vector<Transition> load_at_plane_lifts_off(const SlidingSetting& setting, const SlidingState& at,
                                                const StrandEnd& end, const Arrival& arrival);

}  // namespace arcwall::sliding
