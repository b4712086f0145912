#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall::deck {

/// What a curve through points runs along.
enum class AlongPoints {
  x,      ///< a profile z(x), x strictly increasing
  chord,  ///< an outline, by chord length
  ring,   ///< a closed one, the first point not repeated
};

/// Few points whose interpolating cubic is nowhere farther than `tolerance` from the given points: the least squares
/// over the fewest equal intervals that reach it. Noise below the tolerance leaves no waves. Empty if it takes more
/// intervals than a third of the points, or than 200.
std::optional<std::vector<Vec2>> smoothed(const std::vector<Vec2>& points, double tolerance, AlongPoints along);

}  // namespace arcwall::deck
