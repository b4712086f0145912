#pragma once

#include <string>
#include <vector>

#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/transition.hpp"

namespace arcwall::sliding {

/// Says that a strand is pressed on a straight obstacle from end to end, its free ends included.
void lay_down(const SlidingSetting& setting, Index strand, std::size_t obstacle, LayoutEdit& edit);

/// The state at rest with those strands pressed along straight obstacles that lie on them from end to end and are
/// pressed all along as λ grows from 0 to `toward`. Nothing presses yet.
State with_strands_lying(const SlidingSetting& setting, const SlidingState& rest, double toward);

/// The state in which parts that lie on straight obstacles without pressure, which a load begins to act along as λ goes
/// from here towards a value, are pressed on them or free spans beside them, as the load says.
State with_flat_parts_loaded(const SlidingSetting& setting, const SlidingState& at, double toward);

/// What may lie behind a state where ends of a strand that is pressed all along leave its obstacle: the strand peels
/// off from them. `ends`: true for its last one.
std::vector<Transition> peels_off(const SlidingSetting& setting, const SlidingState& at, Index strand,
                                  const std::vector<bool>& ends);

/// Why λ cannot go on from 0 towards a value while strands lie on obstacles from end to end; empty if it can.
std::string why_not_lying(const SlidingSetting& setting, const SlidingState& at, double toward);

/// Of a hinged end up to which a strand is pressed on a straight obstacle: the moment by which the obstacle holds its
/// slope, positive where it can push so, less half of what the pressure over one element makes of it on the mesh.
struct HoldingMoment {
  double value = 0.0;  ///< [force·length]
  Row row{};
};
HoldingMoment holding_moment(const SlidingSetting& setting, const SlidingState& at, std::size_t tip);

}  // namespace arcwall::sliding
