#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "continuation/path_point.hpp"

namespace arcwall {

/// In which direction a detector's sign must change.
enum class Crossing { any, rising, falling };

/// A function along the path whose zeros are events. It triggers on half-open intervals: a zero where two arcs meet
/// counts once, one at the start of a branch not at all. A program adds its own to TraceOptions::detectors.
struct EventDetector {
  EventKind kind = EventKind::user;
  std::string label{};
  Crossing crossing = Crossing::any;
  std::function<double(const PathPoint&)> value{};  ///< of order 1; its sign is what counts
  std::function<double(const PathPoint&)>
      integral{};  ///< its integral over the arc length, where known: zeros come in pairs
};

/// Signs below this are round-off.
constexpr double detector_noise = 1e-7;

/// −1, 0 (within the noise) or 1.
inline int sign_of(double value) { return std::abs(value) <= detector_noise ? 0 : value > 0.0 ? 1 : -1; }

}  // namespace arcwall
