#pragma once

#include <optional>
#include <vector>

#include "continuation/events/step_events.hpp"

namespace arcwall {

/// A target value between the last point of an active set, at a validity bound, and the nearest point known of the
/// active set behind that bound. Between the two there is the last stretch of the one active set or the first stretch
/// of the other, both too short for their unknowns, or nothing but the errors of two meshes.
struct ValueBetween {
  std::size_t which = 0;  ///< of the target values
  double part = 0.0;      ///< of the way between the two points
  double distance = 0.0;  ///< from the last point of the active set, along its tangent [path metric]
};

/// The first one on the way. A value that the path has passed does not count where the mesh alone moves back over it.
std::optional<ValueBetween> first_value_between(const std::vector<TargetValue>& targets, const PathPoint& behind,
                                                const State& ahead);

/// The point on a value on the active set that ends, a little beyond its bound: the two active sets differ there by the
/// third power of a stretch at most, less than the error of the elements. `near`: its last point, or one beyond the
/// bound. Empty where no such point is found, or where it is inside a wall.
std::optional<PathPoint> point_beyond_bound(TraceTools& tools, const Metric& metric, const PathPoint& near,
                                            const ValueBetween& value);

/// The arc's end on such a point; the bound is passed from there.
std::optional<ArcEnd> land_beyond_bound(TraceTools& tools, const StepOrigin& origin, const ArcEnd& end,
                                        const ValueBetween& value);

/// Moves the first point of the active set ahead onto the value: where a span has all but vanished its active set is of
/// no use. False where no such point is found.
bool land_active_set_ahead(TraceTools& tools, double lambda_scale, const ValueBetween& value, PathPoint& ahead);

}  // namespace arcwall
