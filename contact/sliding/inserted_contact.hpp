#pragma once

#include <optional>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// The start of a step with an open point that follows the least gap which becomes negative within the step; empty
/// where there is none, and where it does not exist at the start yet. See System::check.
std::optional<Transition> with_inserted_contact(const SlidingSetting& setting, const SlidingState& from,
                                                const Direction& forward, const SlidingState& to, double margin);

/// The start of a step that ends where an open point touches, with the elements beside the point divided as its place
/// there divides them; empty where they are. See System::check.
std::optional<Transition> with_mesh_for_touch(const SlidingSetting& setting, const SlidingState& from,
                                              const Direction& forward, const SlidingState& to, Index guard);

}  // namespace arcwall::sliding
