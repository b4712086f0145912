#pragma once

#include <optional>
#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// A clamped end of a strand with the obstacle that it touches tangentially; of several the one towards which the body
/// bends most. Empty where none does, or where the body lies on one beside the clamp.
std::optional<FreeEnd> touched_clamp(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last);

/// What may lie behind a state where the body beside clamps comes to bend as the obstacles there do, at all that do so
/// within `tolerance`: it lies on them from the clamps on.
std::vector<Transition> clamps_are_left(const SlidingSetting& setting, const SlidingState& at, double tolerance);

/// The reverse, where such parts have become short.
std::vector<Transition> parts_gather_at_clamps(const SlidingSetting& setting, const SlidingState& at, double tolerance);

}  // namespace arcwall::sliding
