#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/corners/corner_options.hpp"
#include "continuation/events/event_detector.hpp"
#include "continuation/path_point.hpp"
#include "continuation/path_tolerances.hpp"
#include "continuation/step/corrector_options.hpp"
#include "continuation/step/path_constraint.hpp"
#include "continuation/step/step_attempt.hpp"
#include "continuation/step/step_control.hpp"
#include "core/algebra/factorization.hpp"

namespace arcwall {

/// Defines a stop bound, an output point or an event: a value of a quantity, solved for.
struct TargetValue {
  std::shared_ptr<const Observable> quantity{};
  double value = 0.0;     ///< in the unit of the quantity
  double roundoff = 0.0;  ///< of the quantity where it is zero, likewise
  bool stops = false;     ///< true: the branch ends there
  std::string label{};    ///< for messages: `mid = -0.16`
  std::string event{};    ///< label of the events at which the value is passed; empty: it is no event
};

/// Defines a kind of event that ends the branch.
struct StopEvent {
  EventKind kind = EventKind::limit_point;
  std::string label{};  ///< for messages: `event = limit-point`
};

/// Selects how zeros of the detectors inside a step are treated.
enum class EventSearch {
  locate,  ///< solve for each; it becomes a point of the path
  detect,  ///< report it at the end of the step, with the interval
  none,    ///< ignore
};

/// Options of a tracer. The defaults need no tuning.
struct TraceOptions {
  PathMethod method = PathMethod::spherical;
  std::shared_ptr<const Observable> control{};  ///< controlled quantity of `displacement`; else null
  StepOptions step{};
  CorrectorOptions corrector{};
  CornerOptions corner{};
  std::vector<TargetValue> target_values{};
  std::optional<Index> stop_contacts{};  ///< number of closed contacts that ends the branch
  std::vector<StopEvent> stop_events{};  ///< the first event of any of these kinds ends the branch
  EventSearch events = EventSearch::locate;
  std::vector<EventDetector> detectors{};  ///< in addition to limit points and watched monitors
  /// Of each contact 1 if it is at a node and stands for contact along a member: branch points with such a contact get
  /// `mesh_artefact`. Empty: none is.
  std::vector<std::uint8_t> node_contacts{};
  double guard_tolerance = 1e-12;  ///< a guard is satisfied above −this, degenerate within ±this [scale of guards]
  /// Mesh error of a vanishing contact force [scale of guards]. Less than that of other guards if round-off determines
  /// the scale.
  double mesh_error_of_forces = mesh_error;

  /// Returns the mesh error of a guard [scale of guards].
  double mesh_error_of(const ActiveSet& active_set, Index guard) const {
    const bool is_force = guard < static_cast<Index>(active_set.size()) && active_set[static_cast<std::size_t>(guard)];
    return is_force ? mesh_error_of_forces : mesh_error;
  }

  double localisation = 1e-12;  ///< width of an event's bracket over its step length [-]
  std::optional<double>
      lambda_scale{};  ///< λ₀ of the metric if BranchStart has none; empty: from the tangent stiffness
  int max_points = 5000;
  bool every_direction = false;  ///< report a branch point at each active-set change with several outgoing directions,
                                 ///< also if only one of them is stable
  std::function<void(const StepAttempt&)> ledger{};  ///< called after each attempted step
  MakeFactorization factorization = make_ldlt;       ///< creates the factorization of the tangent stiffness
  bool stay = false;  ///< if all outgoing directions are unstable: prefer one with the old active set
};

/// Defines a monitor whose turning points are events.
struct Watch {
  enum class Kind {
    motion,         ///< the path metric measures it
    contact_force,  ///< a sum of multipliers
    inner_force,    ///< told by strains: a reaction, what a member or a spring carries
  };

  std::shared_ptr<const Observable> quantity{};
  std::string label{};
  Kind kind = Kind::motion;
};

/// Stores a branch point on another branch.
struct KnownPoint {
  State state{};
  int branch = 0;
};

/// Stores the start of a branch at a pitchfork with an active-set change (BranchPoint::at_corner). The tangent
/// stiffness is singular there, because the new contact zone has no length; no step can start there.
struct EnteredBranch {
  State begin{};          ///< equilibrium near the branch point; the zone may be shorter than its bound
  Direction tangent{};    ///< unit tangent at `begin`, away from the branch point
  State first{};          ///< first equilibrium after it with all guards ≥ 0
  double distance = 0.0;  ///< distance of `begin` along the mode [path metric]
};

/// Stores the start of a branch: a state alone, a branch point with a tangent (`forward`), or a branch point with an
/// active-set change (`entered`).
struct BranchStart {
  State state{};
  int sense = 1;                       ///< of a state alone: 1 in the direction of StepOptions::first, −1 against it
  std::optional<Direction> forward{};  ///< unit tangent at a branch point
  std::optional<EnteredBranch> entered{};  ///< after an active-set change
  Direction mode{};                        ///< critical mode; its component is constant in the first step
  double distance = 0.02;                  ///< length of the first step from a branch point [path metric]
  std::optional<double> lambda_scale{};    ///< λ₀ of the metric, as on the branches before
  std::vector<KnownPoint> known{};         ///< branch points at which this branch ends (reached_branch)
};

}  // namespace arcwall
