#pragma once

#include <optional>

#include "continuation/events/singular_point.hpp"
#include "continuation/step/point_on_path.hpp"

namespace arcwall {

/// An event, located: its point and its place in the step.
struct LocatedEvent {
  EventPlace place{};
  std::optional<PathPoint> point{};                      ///< empty: the search failed
  CorrectorStatus failure = CorrectorStatus::converged;  ///< of the correction at which it failed
};

/// Locates what `place` estimates in the step that ends at `to`: lands on a target value, whose value is the
/// constraint; searches for a detector's zero.
LocatedEvent locate(TraceTools& tools, const StepOrigin& origin, const EventPlace& place, const PathPoint& to);

}  // namespace arcwall
