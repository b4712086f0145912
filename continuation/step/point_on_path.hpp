#pragma once

#include <optional>

#include "continuation/segment.hpp"
#include "continuation/trace_tools.hpp"
#include "core/system.hpp"

namespace arcwall {

/// A point of the path that a correction led to, or why there is none.
struct CorrectedPoint {
  std::optional<PathPoint> point{};
  CorrectorStatus status = CorrectorStatus::converged;  ///< also where the corrector arrived at a point off the step
};

/// What the corrector found as a point of the path, with its guards; its tangent in the sense of `forward`.
PathPoint path_point(const System& system, const Metric& metric, CorrectorResult result, const Direction& forward);

/// The point inside a step that fulfils a constraint, from a guess at fraction t of the segment, which begins at the
/// step's origin.
CorrectedPoint correct_onto(TraceTools& tools, const StepOrigin& origin, const PathConstraint& constraint,
                            const Segment& segment, double t);

/// The same from a guess at a distance from points that are known.
CorrectedPoint correct_onto(TraceTools& tools, const StepOrigin& origin, const PathConstraint& constraint,
                            const Segment& segment, State guess, double distance, Wanted wanted);

/// Adds the eigenpairs nearest zero and their count to a point that was found without them.
void find_pairs(TraceTools& tools, const Metric& metric, PathPoint& at);

/// Adds the number of negative eigenvalues where the pivots have not told it.
void decide_count(TraceTools& tools, PathPoint& point);

/// The point at fraction t of a segment with its count. Empty if there is none, or its count is not known.
std::optional<PathPoint> counted_point(TraceTools& tools, const StepOrigin& origin, const Segment& segment, double t);

}  // namespace arcwall
