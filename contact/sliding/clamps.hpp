#pragma once

#include <optional>
#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "contact/sliding/validity_bound.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// A clamped end of a strand with the obstacle that it touches tangentially, or a hinged one with a straight obstacle
/// that it is on; of several the one that the body is about to lie on first. Empty where none touches, or where the
/// body lies on one beside the end.
std::optional<FreeEnd> touched_clamp(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last);

/// What keeps the body from lying on the obstacle beside such an end, scaled: at a clamp the curvature gap (8.5), at a
/// hinge the sine of the angle by which the body leaves the obstacle.
double parting(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);
Row parting_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// What may lie behind a state where the body beside clamps comes to bend as the obstacles there do, at all that do so
/// together: it lies on them from the clamps on.
std::vector<Transition> clamps_are_left(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival);

/// The reverse, where such parts have become short.
std::vector<Transition> parts_gather_at_clamps(const SlidingSetting& setting, const SlidingState& at,
                                               const Arrival& arrival);

}  // namespace arcwall::sliding
