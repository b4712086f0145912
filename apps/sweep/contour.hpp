#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace arcwall::sweep {

/// Values at the crossings of lines x and y; empty where there is none.
struct GridValues {
  std::vector<double> x{}, y{};                 ///< ascending
  std::vector<std::optional<double>> values{};  ///< of (x₀, y₀), (x₀, y₁), …: y changes fastest

  const std::optional<double>& at(std::size_t i, std::size_t j) const { return values[i * y.size() + j]; }
};

/// Where the values, interpolated along the sides of the grid's cells, are equal to a level: straight parts, each in a
/// cell that has all its four values. Where both ways to join the sides of a cell are right, the mean of its corners
/// tells.
struct ContourPart {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};
std::vector<ContourPart> contour(const GridValues& grid, double level);

}  // namespace arcwall::sweep
