/// Tolerances of points on paths that several parts of the tracer share.
#pragma once

namespace arcwall {

/// Points of a path that are nearer to each other are one [path metric].
inline constexpr double coincidence_tolerance = 1e-8;

/// Penetration that is let pass between contacts [scale of guards].
inline constexpr double penetration_tolerance = 1e-11;

/// What the error of a mesh may make of a guard that is zero [scale of guards].
inline constexpr double mesh_error = 1e-6;

/// How exactly places on a path near which it is singular are known [path metric].
inline constexpr double singular_point_accuracy = 1e-5;

/// How far behind a branch point the unstable directions of a branch that leaves it are counted: of its first step. K
/// is regular there again, and another singular point hardly lies between.
inline constexpr double just_behind = 0.05;

}  // namespace arcwall
