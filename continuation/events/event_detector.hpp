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

struct Watch;

/// Sign changes that a detector reports.
enum class Crossing { any, rising, falling };

/// Defines a function along the path whose zeros are events. Add it to TraceOptions::detectors. A zero between two arcs
/// counts once; a zero at the start of a branch is ignored.
struct EventDetector {
  EventKind kind = EventKind::user;
  std::string label{};
  Crossing crossing = Crossing::any;
  std::function<double(const PathPoint&)> value{};  ///< of order 1
  /// Integral of `value` over the arc length, to detect pairs of zeros inside a step; may be empty.
  std::function<double(const PathPoint&)> integral{};
};

/// Returns true if the detector reports this change of sign; both signs are −1, 0 or 1.
inline bool triggers(const EventDetector& detector, int before, int after) {
  const bool wanted = detector.crossing == Crossing::any || (after > 0) == (detector.crossing == Crossing::rising);
  return before * after < 0 && wanted;
}

/// Returns the type of a limit point from the sign of λ′ before it; empty for other kinds, and if the sign is 0.
inline std::optional<Extremum> extremum_at(EventKind kind, int before) {
  if (kind != EventKind::limit_point || before == 0) return std::nullopt;
  return before > 0 ? Extremum::maximum : Extremum::minimum;
}

/// Returns the detector of limit points: λ′ of the unit tangent, scaled to [−1, 1].
EventDetector limit_point_detector(const Metric& metric);

/// Returns the detector of turning points: the derivative of the watched quantity along the unit tangent, scaled to
/// [−1, 1].
EventDetector turning_detector(const Equations& system, const Metric& metric, const Watch& watch);

/// Signs below this are round-off.
constexpr double detector_noise = 1e-7;

/// Returns −1, 0 (|value| ≤ detector_noise) or 1.
inline int sign_of(double value) { return std::abs(value) <= detector_noise ? 0 : value > 0.0 ? 1 : -1; }

}  // namespace arcwall
