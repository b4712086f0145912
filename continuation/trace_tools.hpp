#pragma once

#include <vector>

#include "continuation/corners/outgoing_directions.hpp"
#include "continuation/metric.hpp"
#include "continuation/stability.hpp"
#include "continuation/step/corrector.hpp"
#include "continuation/tracer_state.hpp"
#include "core/system.hpp"

namespace arcwall {

/// What a branch is traced with: its equations and options, which stay, and workspaces, which leave no trace in
/// results.
struct TraceTools {
  const System& system;
  TraceOptions options;
  Corrector corrector;
  StabilityCounter counter;
  CornerWorkspace corner_workspace{};
  std::vector<EventDetector> detectors{};  ///< limit points, turning points of watched monitors, the program's own

  /// `from_system` must outlive this.
  TraceTools(const System& from_system, TraceOptions from_options);
  TraceTools(const TraceTools&) = delete;  // the counter shares the corrector's equations

  /// The equations of an active set, to be evaluated where the corrector is not.
  Linearization& workspace(const ActiveSet& active_set) { return corrector.factorized().workspace(active_set); }

  Metric metric_on(const ActiveSet& active_set, double lambda_scale) const {
    return {system.weights(active_set), lambda_scale};
  }

  /// Whether closed contacts are tied to nodes where a continuum's would move along the body. They may make a branch
  /// point that the continuum has not.
  bool ties_contact_to_nodes(const ActiveSet& active_set) const;
};

/// How long a correction may take. Of a nearly perfect structure hardly more than the sum of the lengths of straight
/// contacts is determined, and corrections swing before they settle; where a span has just begun round-off leaves their
/// last ones.
enum class Effort { usual, patient };

/// Where a step begins, and what is known there.
struct StepOrigin {
  const Departure& from;
  const BranchStart& start;          ///< of the branch
  Metric metric;                     ///< of the active set of `from`
  bool leaves_branch_point = false;  ///< the step is the first one off a branch point
  Effort effort = Effort::usual;     ///< of its correction

  const PathPoint& point() const { return from.point; }
};

/// Signs of the detectors at a point: −1, 0 within the noise, or 1.
std::vector<int> signs_at(const std::vector<EventDetector>& detectors, const PathPoint& point);

}  // namespace arcwall
