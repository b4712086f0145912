#pragma once

#include <string>
#include <vector>

#include "apps/sweep/map_point.hpp"

namespace arcwall::sweep {

/// Loads over two varied keys, or over one.
struct LoadMap {
  MapTitles titles{};
  std::vector<MapPoint> points{};  ///< at least one
};

/// The map as an SVG element: of a full grid in cells, with lines of equal load where its keys are numbers with four
/// values or more; of other cases in points, coloured by their loads; with one key the loads over it. Cases without a
/// load are hollow, failed ones crossed. Texts are escaped.
std::string svg(const LoadMap& map);

}  // namespace arcwall::sweep
