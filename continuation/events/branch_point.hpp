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

/// What round-off may make of that; `workspace` as the rate left it.
double eigenvalue_rate_roundoff(const Vector& left, const Linearization& workspace);

/// What a singular place is: its modes, its type and the tangents of the branches that cross there. Where no mode can
/// be computed, `mode` stays empty.
BranchPoint branch_point_at(const Equations& system, Corrector& corrector, const Metric& metric,
                            const SingularPlace& place);

/// A first point on a bifurcated branch.
struct SteppedOff {
  State state{};
  Direction tangent{};  ///< away from the branch point, of unit length
};

/// Leaves the branch point along ± its other tangent by a distance near `distance`; halves it while a guard is violated
/// by more than the tolerance or the step falls back onto the old branch.
std::optional<SteppedOff> step_off(const System& system, Corrector& corrector, const Metric& metric,
                                   const BranchPoint& point, int sign, double distance, double guard_tolerance);

}  // namespace arcwall
