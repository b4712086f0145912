#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "continuation/metric.hpp"
#include "continuation/path_point.hpp"
#include "core/equations.hpp"
#include "core/observable.hpp"

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
  /// Its integral over the arc length, where known: it shows zeros that come in pairs inside a step.
  std::function<double(const PathPoint&)> integral{};
};

/// Whether a change of sign is one of the detector's events.
inline bool triggers(const EventDetector& detector, int before, int after) {
  const bool wanted = detector.crossing == Crossing::any || (after > 0) == (detector.crossing == Crossing::rising);
  return before * after < 0 && wanted;
}

/// Which way λ turns where a detector triggers that had this sign before; empty if it is not that of limit points.
inline std::optional<Extremum> extremum_at(EventKind kind, int before) {
  if (kind != EventKind::limit_point || before == 0) return std::nullopt;
  return before > 0 ? Extremum::maximum : Extremum::minimum;
}

/// λ′ of the unit tangent, scaled to [−1, 1]: its zeros are limit points.
EventDetector limit_point_detector(const Metric& metric);

/// The rate of a quantity along the unit tangent, scaled likewise: its zeros are turning points of the quantity.
EventDetector turning_detector(const Equations& system, const Metric& metric,
                               std::shared_ptr<const Observable> quantity, std::string label);

/// Signs below this are round-off.
constexpr double detector_noise = 1e-7;

/// −1, 0 (within the noise) or 1.
inline int sign_of(double value) { return std::abs(value) <= detector_noise ? 0 : value > 0.0 ? 1 : -1; }

}  // namespace arcwall
