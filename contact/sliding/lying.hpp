#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// Whether an obstacle is straight where it faces a place that touches it.
bool is_flush_at(const Obstacle& surface, const Vec2& place, double lambda);

/// Whether a part of a strand lies flush on a straight obstacle at rest, and the rest of it does not.
bool rests_on_part(const SlidingSetting& setting, const SlidingState& rest);

/// Says that a strand is pressed on a straight obstacle from end to end, its free ends included.
void lay_down(const SlidingSetting& setting, Index strand, std::size_t obstacle, LayoutEdit& edit);

/// The state at rest with those strands pressed along straight obstacles that lie on them from end to end and are
/// pressed all along as λ grows from 0 to `toward`. Nothing presses yet.
State with_strands_lying(const SlidingSetting& setting, const SlidingState& rest, double toward);

/// The state in which strands that have come down on straight obstacles, so that they touch these from end to end, are
/// pressed on them all along as λ goes on towards a value. A body that falls flush touches with all of its length at
/// once, or up to a rest that hardly any load lifts: no contact after the other closes. Empty where no strand does so.
std::optional<State> with_strands_come_to_lie(const SlidingSetting& setting, const SlidingState& at, double toward);

/// The state in which parts that lie on straight obstacles without pressure, which a load begins to act along as λ goes
/// from here towards a value, are pressed on them or free spans beside them, as the load says.
State with_flat_parts_loaded(const SlidingSetting& setting, const SlidingState& at, double toward);

/// What may lie behind a state where ends of a strand that is pressed all along leave its obstacle: the strand peels
/// off from them. `ends`: true for its last one.
std::vector<Transition> peels_off(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                  const std::vector<bool>& ends);

/// Why λ cannot go on from 0 towards a value while strands lie on obstacles from end to end; empty if it can.
std::string why_not_lying(const SlidingSetting& setting, const SlidingState& at, double toward);

/// Of an end up to which a part is pressed on a straight obstacle: the moment by which the obstacle holds its slope,
/// positive where it can push so, less so many times half of what the pressure over one element makes of it on the
/// mesh.
struct HoldingMoment {
  double value = 0.0;  ///< [force·length]
  Row row{};
};
HoldingMoment holding_moment(const SlidingSetting& setting, const SlidingState& at, std::size_t tip, double halves);

}  // namespace arcwall::sliding
