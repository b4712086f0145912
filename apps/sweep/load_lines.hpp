#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/map_point.hpp"

namespace arcwall::sweep {

/// Cases that differ in one key, in the order of its values.
struct LoadLine {
  std::string name{};  ///< the values of the other keys; may be empty
  Json panel{};        ///< value of the second key; null without one
  std::vector<MapPoint> points{};

  /// λ₀: the load of the case in which the key is nearest to 0, of texts the first; empty where that case failed or has
  /// no such event. Of an imperfection's amplitude it is the load of the structure that comes next to a perfect one.
  std::optional<double> reference() const;
};

/// Loads over the first key, a line for each combination of the values of the others.
struct LoadLines {
  MapTitles titles{};
  std::vector<LoadLine> lines{};
};

/// Whether any two cases differ in the first key alone; there is nothing to draw else.
bool has_lines(const LoadLines& lines);

/// λ over the key. Empty where there is nothing to draw.
std::string lines_svg(const LoadLines& lines);

/// λ/λ₀ over the key; what has no λ₀ is left out. Empty where there is nothing to draw.
std::string knockdown_svg(const LoadLines& lines);

/// λ over the first key, in a panel of its own for each value of the second key, all to one scale and with the lines of
/// the other panels in grey. Empty with more than sixteen values of it, or fewer than two.
std::string panels_svg(const LoadLines& lines);

}  // namespace arcwall::sweep
