#pragma once

#include <optional>
#include <vector>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "contact/sliding/validity_bound.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// Whether an end is at a joint beyond which the face that touches goes on in line, and turns with it.
bool face_goes_on(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// What presses an end on its obstacle where the body is straight up to there: point loads, springs and the natural
/// curvature [force]; and its derivatives by the unknowns and λ.
double presses_end(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);
Row presses_end_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end);

/// The closed contact of an end with the obstacle on which a part is pressed up to there, by its number among the free
/// ends; empty where there is none.
std::optional<std::size_t> pressed_contact(const SlidingSetting& setting, const SlidingState& at, const StrandEnd& of);

/// What may lie behind a state where ends on rollers, tips or joints that touch become tangent to their obstacles, the
/// likeliest first: all that do so together. Contact moves inside, and the tip lifts off, where the body bends away
/// from the obstacle there; where it bends with it, it lies on the obstacle up to the tip.
std::vector<Transition> tips_lie_down(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival);

/// The reverse, where points have come to such ends: the contact there is at the end.
std::vector<Transition> contacts_come_to_tips(const SlidingSetting& setting, const SlidingState& at,
                                              const Arrival& arrival);

/// What may lie behind a state where a part that is pressed on an obstacle up to tips does not stay so: it peels off
/// from them, be they `lifted` off the obstacle, or stay there with an arch beside them.
std::vector<Transition> peel_off_from_tips(const SlidingSetting& setting, const SlidingState& at,
                                           const std::vector<StrandEnd>& tips, bool lifted);

/// What lies behind a state where the arch between a joint and a contact point on one straight wall vanishes: with the
/// point's curvature gap goes the angle at the joint, as nothing acts between them. From there to the point the body
/// lies on the wall at once, the zone's other edge comes in from the joint, and that leaves the wall. Empty elsewhere.
std::vector<Transition> zones_leave_joints(const SlidingSetting& setting, const SlidingState& at,
                                           const Arrival& arrival);

/// Where the body behind a point that loses its curvature gap bends all along as the obstacle does, up to a tip that it
/// thereby touches: the contact of the tip closes. Empty elsewhere.
std::optional<Transition> tip_touches_with(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

}  // namespace arcwall::sliding
