#pragma once

#include "continuation/trace_tools.hpp"
#include "core/system.hpp"

namespace arcwall {

/// The guess for the end of a step of length s: along the cubic through the last two points and their tangents, else
/// along the tangent. What is controlled has its value where the tangent leads; where guards are in reach steps end at
/// changes of contact as often as not, and the tangent does not overshoot them.
State predicted(const System& system, PathMethod method, const StepOrigin& origin, double s);

}  // namespace arcwall
