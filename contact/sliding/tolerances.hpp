/// Thresholds and difference steps of moving contact, by what they are compared with. Lengths of spans and elements at
/// which a layout changes: spans.hpp.
#pragma once

namespace arcwall::sliding {

// --- guards [-] -----------------------------------------------------------------------------------------------------

/// Values of a guard that cannot vanish at a state; of one beside which steps may be long, since another guard vanishes
/// first.
inline constexpr double no_guard = 1.0, no_guard_for_long = 10.0;

/// Guards that vanish together with the one that was located: nearer to zero than the first and falling, or nearer than
/// the second; the path length over which they fall [path metric].
inline constexpr double reached_nearly = 1e-6, reached_surely = 1e-9, reached_within = 1e-3;

/// The first of these where a structure is symmetric but for weak springs.
inline constexpr double reached_in_weak_asymmetry = 1e-5;

/// Penetration that counts beside an end with a guard of its own.
inline constexpr double penetrates_beside_end = -1e-11;

// --- gaps and lengths [length scale] and angles [rad] ---------------------------------------------------------------

/// Gap and angle of a body that touches a wall at rest, at a support or where a line forms.
inline constexpr double touching_at_rest = 1e-9;

/// Gap of a body that touches a wall along a path; places that are one.
inline constexpr double touching_on_path = 1e-6;

/// The gap of an end that touches together with a contact point.
inline constexpr double touching_with_point = 1e-8;

/// The gap over which a least gap changes between two meshes of one state.
inline constexpr double between_meshes = 1e-5;

/// Angles between directions that are parallel: of supports and walls, and of an axis and a wall.
inline constexpr double exactly_parallel = 1e-9, nearly_parallel = 1e-6;

/// Curvature times the length scale, and angle, of a straight axis.
inline constexpr double nearly_straight = 1e-6;

// --- forces [force scale] -------------------------------------------------------------------------------------------

/// Round-off of forces that are zero.
inline constexpr double zero_force = 1e-9;

/// Round-off of rates of forces that λ does not drive, relative to the load.
inline constexpr double zero_rate = 1e-12;

// --- differences ----------------------------------------------------------------------------------------------------

/// Steps of central differences, relative to the strand's length, an angle of 1 or λ = 1: of smooth functions with
/// order four; of walls, which have ends and arcs between lines; of places on one smooth piece.
inline constexpr double difference_step = 1e-3, difference_step_on_wall = 1e-5, difference_step_at_place = 1e-6;

}  // namespace arcwall::sliding
