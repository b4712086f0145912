#pragma once

#include <optional>
#include <vector>

#include "continuation/corners/corner.hpp"

namespace arcwall {

/// The detectors of the ends of slips, one a contact with friction: a slip ends where its rate changes its sign along
/// the path.
std::vector<EventDetector> slip_end_detectors(const System& system);

/// The contact of a point that slips slowest in its own sense, the first whose slip ends; empty where none slips.
std::optional<Index> slowest_slip(const FrictionalContact& friction, const PathPoint& at);

/// Leaves a point at which contacts with friction may change what they do (docs/theory.md, section 18). `landed`: the
/// guard that was landed on, if one was; `ended`: the contact whose slip has ended there, if one has.
CornerPassed turn_friction_corner(TraceTools& tools, Corner corner, std::optional<Index> landed,
                                  std::optional<Index> ended);

/// Whether contacts with friction change at once at the first point behind a change of what is in contact: one slips
/// against its sense there, or sticks beyond its bound.
bool must_change_behind(const TraceTools& tools, const PathPoint& at);

/// Whether a branch begins at a point where contacts with friction may change: some touch without force, or slip, as
/// after a stage that went on in another sense.
bool may_change_at_start(const TraceTools& tools, const PathPoint& at);

}  // namespace arcwall
