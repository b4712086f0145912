#pragma once

#include <cmath>

#include "core/types.hpp"

namespace arcwall {

/// The unit vector at an angle from the x axis, towards z [rad].
inline Vec2 unit_tangent(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace arcwall
