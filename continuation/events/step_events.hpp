#pragma once

#include <optional>
#include <vector>

#include "continuation/events/singular_point.hpp"
#include "continuation/step/landing.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// The end of an arc: that of its step, or the first event before it.
struct ArcEnd {
  PathPoint point{};
  double length = 0.0;                    ///< of the arc [path metric]
  std::optional<EventPlace> event{};      ///< what ends the arc, where it is not the step alone
  std::vector<SingularPoint> singular{};  ///< the first at `point`, others just behind it
  PathPoint beyond{};                     ///< where the step led, of an arc that ends at an event
  bool changes_beyond = false;            ///< contacts change there, so that one of them holds no more
  std::optional<Landing> landing{};       ///< contacts change at `point`
  std::optional<Landing> passed_bound{};  ///< a validity bound that lies a little before `point`, a target value
  double turn = 0.0;                      ///< of the tangent over the step that was tried [rad]
  bool over_kink = false;                 ///< the arc leads over a kink of the path alone, which is at `point`

  /// Whether the equations are singular where contacts change.
  bool at_singular_change() const { return landing && landing->singular; }
};

/// An arc's end, or why it is not sure.
struct ArcEndSearch {
  std::optional<ArcEnd> end{};                           ///< empty: an event inside could not be located
  CorrectorStatus failure = CorrectorStatus::converged;  ///< of the correction at which that showed
};

/// Ends an arc at the first event inside a step: a singular point, a detector's zero or a target value. Where singular
/// points are pending the step leads to the first of these.
ArcEndSearch locate_events(TraceTools& tools, const StepOrigin& origin, StepEnd step);

/// The events at an arc's end, contacts not changing; `behind`: the count just behind it.
std::vector<Event> events_at(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                             const StabilityCount& behind);

/// The events of values that are passed on the way to an arc's end, where a change of contact may have led to `at`.
std::vector<Event> value_crossings(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                                   const PathPoint& at, const StabilityCount& behind);

/// The count just behind an arc's end, contacts not changing.
StabilityCount count_behind(TraceTools& tools, const StepOrigin& origin, const ArcEnd& end);

/// The signs of the detectors just behind an arc's end, contacts not changing.
std::vector<int> signs_behind(const TraceTools& tools, const StepOrigin& origin, const ArcEnd& end);

}  // namespace arcwall
