#pragma once

#include <functional>
#include <string>

#include "continuation/path_point.hpp"

namespace arcwall {

/// A function along the path whose zeros are events.
struct EventDetector {
  EventKind kind = EventKind::limit_point;
  std::string label{};
  std::function<double(const PathPoint&)> value{};  ///< of order 1; its sign is what counts
  std::function<double(const PathPoint&)>
      integral{};  ///< its integral over the arc length, where known: zeros come in pairs
};

/// Signs below this are round-off.
constexpr double detector_noise = 1e-7;

}  // namespace arcwall
