#pragma once

#include <optional>

#include "continuation/events/singular_place.hpp"
#include "continuation/path_point.hpp"
#include "continuation/step/corrector.hpp"
#include "core/system.hpp"

namespace arcwall {

/// φᵀ (∂K·d) φ by central differences: how fast an eigenvalue changes along a direction. The first φ is the left null
/// vector of ∂F/∂x, the second the right one.
double eigenvalue_rate(const Equations& system, const State& state, const Direction& d, const Vector& left,
                       const Vector& mode, Linearization& workspace);

/// What round-off of K's entries may make of that; `workspace` as the rate left it.
double eigenvalue_rate_roundoff(const Vector& left, const Vector& mode, const Linearization& workspace);

/// What a singular place is: its modes, its type and the tangents of the branches that cross there. Where no mode can
/// be computed, `mode` stays empty.
BranchPoint branch_point_at(const Equations& system, Corrector& corrector, const Metric& metric,
                            const SingularPlace& place);

/// The same of a place right behind which the path's point is and K is regular: the mode is that of the negative
/// eigenvalue nearest zero.
BranchPoint branch_point_before(const Equations& system, Corrector& corrector, const Metric& metric,
                                const PathPoint& behind);

/// The branch across a pitchfork that is met along its own branch: there λ turns, the path's direction is the mode, and
/// its eigenvalue touches zero. K y = −F_λ across the mode gives the other tangent. Makes `point` symmetric, with both
/// ways along it; leaves it as it is where it is no such point.
void find_crossing_branch(Corrector& corrector, const Metric& metric, BranchPoint& point);

/// How a branch leaves a branch point.
struct WayOff {
  Direction forward{};  ///< unit tangent
  Direction across{};   ///< its part across the path, along which the first step is measured: no plane across it
                        ///< meets the old branch, so that the step cannot fall back onto that
};

/// Both ways along the other branch, ± its tangent. That of a pitchfork is orthogonal to the path by symmetry, of whose
/// tangent at a singular place part is round-off, which would tell mirror images from each other.
WayOff way_off(const Metric& metric, const BranchPoint& point, int sign);

/// By how much of the chord on which its rate was taken round-off in the factors of K may move a singular place: an
/// eigenvalue that they are not sure of may be zero there. The corrector is at the place, as branch_point_at() left it.
double roundoff_width(Corrector& corrector, const Metric& metric, const SingularPlace& place, const BranchPoint& point);

/// A first point on a bifurcated branch.
struct SteppedOff {
  State state{};
  Direction tangent{};    ///< away from the branch point, of unit length
  double distance = 0.0;  ///< along the way that led there [path metric]
};

/// Leaves the branch point along a way by `distance`, halved until it fits before the walls that are near, and some
/// times more while a guard is violated by more than the tolerance or the step falls back onto the old branch.
std::optional<SteppedOff> step_off(const System& system, Corrector& corrector, const Metric& metric,
                                   const BranchPoint& point, const WayOff& way, double distance,
                                   double guard_tolerance);

}  // namespace arcwall
