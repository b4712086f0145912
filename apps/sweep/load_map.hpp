#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/design.hpp"

namespace arcwall::sweep {

/// A case on a map.
struct MapPoint {
  int number = 0;
  Json x{}, y{};                 ///< values of the varied keys; y is not looked at with one key
  std::optional<double> load{};  ///< empty: the case has no such event
  bool failed = false;
};

struct LoadMap {
  std::string x_title{};
  std::string y_title{};  ///< empty: one key alone, and loads are drawn over it
  std::string load_title{};
  std::string load_unit{};         ///< of the loads: what λ multiplies; may be empty
  std::vector<MapPoint> points{};  ///< at least one
};

/// The map as an SVG element: of a full grid in cells, of other cases in points, coloured by their loads; with one key
/// the loads over it. Cases without a load are hollow, failed ones crossed. Texts are escaped.
std::string svg(const LoadMap& map);

}  // namespace arcwall::sweep
