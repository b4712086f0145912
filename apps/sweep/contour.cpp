#include "apps/sweep/contour.hpp"

#include <array>

namespace arcwall::sweep {

namespace {

struct Corner {
  Vec2 at = Vec2::Zero();
  double value = 0.0;
};

using Cell = std::array<Corner, 4>;  // anticlockwise

std::optional<Cell> cell_at(const GridValues& grid, std::size_t i, std::size_t j) {
  Cell cell;
  constexpr std::array<std::array<std::size_t, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t k = 0; k < around.size(); ++k) {
    const std::size_t ci = i + around[k][0], cj = j + around[k][1];
    if (!grid.at(ci, cj)) return std::nullopt;
    cell[k] = {.at = {grid.x[ci], grid.y[cj]}, .value = *grid.at(ci, cj)};
  }
  return cell;
}

// On each side of the cell whose ends lie on either side of the level, in their order.
std::vector<Vec2> crossings(const Cell& cell, double level) {
  std::vector<Vec2> places;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Corner &a = cell[k], &b = cell[(k + 1) % cell.size()];
    if ((a.value < level) == (b.value < level)) continue;
    places.push_back(a.at + (level - a.value) / (b.value - a.value) * (b.at - a.at));
  }
  return places;
}

}  // namespace

std::vector<ContourPart> contour(const GridValues& grid, double level) {
  std::vector<ContourPart> parts;
  for (std::size_t i = 0; i + 1 < grid.x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < grid.y.size(); ++j) {
      const auto cell = cell_at(grid, i, j);
      if (!cell) continue;
      const std::vector<Vec2> places = crossings(*cell, level);
      if (places.size() == 2) parts.push_back({.from = places[0], .to = places[1]});
      if (places.size() != 4) continue;
      double mean = 0.0;
      for (const Corner& corner : *cell) mean += 0.25 * corner.value;
      // The sides around a corner on the other side of the level than the middle belong together.
      const bool first_is_cut_off = (mean < level) != ((*cell)[0].value < level);
      if (first_is_cut_off) {
        parts.push_back({.from = places[3], .to = places[0]});
        parts.push_back({.from = places[1], .to = places[2]});
      } else {
        parts.push_back({.from = places[0], .to = places[1]});
        parts.push_back({.from = places[2], .to = places[3]});
      }
    }
  }
  return parts;
}

}  // namespace arcwall::sweep
