/// Tolerances of points on paths that several parts of the tracer share.
#pragma once

namespace arcwall {

/// Distance below which points of a path coincide [path metric].
inline constexpr double coincidence_tolerance = 1e-8;

/// Cosine above which two directions in which the structure moves are one.
inline constexpr double same_way = 1.0 - 1e-6;

/// Penetration that is accepted between contacts [scale of guards].
inline constexpr double penetration_tolerance = 1e-11;

/// Mesh error of a vanishing guard [scale of guards].
inline constexpr double mesh_error = 1e-6;

/// Accuracy of points near a singular point [path metric].
inline constexpr double singular_point_accuracy = 1e-5;

/// Distance past a kink of the path of the point that stands for it: far enough for round-off to tell the side [path
/// metric].
inline constexpr double kink_accuracy = 1e-12;

/// Distance from a branch point at which the unstable directions of an outgoing branch are counted, over its first
/// step.
inline constexpr double just_behind = 0.05;

}  // namespace arcwall
