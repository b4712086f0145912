#pragma once

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

/// A bound that ends the branch, or a value to land on and go on.
struct TargetValue {
  std::shared_ptr<const Observable> quantity{};
  double value = 0.0;
  bool stops = false;
  std::string label{};  ///< for messages: `mid = -0.16`
};

/// A kind of event that ends the branch.
struct StopEvent {
  EventKind kind = EventKind::limit_point;
  std::string label{};  ///< for messages: `event = limit-point`
};

/// What is done about zeros of the detectors inside a step.
enum class EventSearch {
  locate,  ///< each becomes a point of the path
  detect,  ///< reported at the end of the step, with the interval
  none,
};

/// What to trace and how. The defaults need no tuning.
struct TraceOptions {
  PathMethod method = PathMethod::spherical;
  std::shared_ptr<const Observable> control{};  ///< of `displacement`
  StepOptions step{};
  CorrectorOptions corrector{};
  CornerOptions corner{};
  std::vector<TargetValue> target_values{};
  std::optional<Index> stop_contacts{};  ///< number of closed contacts that ends the branch
  std::vector<StopEvent> stop_events{};  ///< the first of any of these ends the branch
  EventSearch events = EventSearch::locate;
  std::vector<EventDetector> detectors{};  ///< besides limit points and watched monitors
  bool node_contacts = false;      ///< contacts cannot slide along the body: branch points with closed ones are marked
  double guard_tolerance = 1e-12;  ///< guards above −this are fulfilled, those within it degenerate
  /// What the error of a mesh may make of the force of a closed contact that is zero [scale of guards]. Less than of
  /// other guards where round-off makes the scale greater than forces are.
  double mesh_error_of_forces = mesh_error;

  /// The same of any guard of a piece.
  double mesh_error_of(const Piece& piece, Index guard) const {
    const bool is_force = guard < static_cast<Index>(piece.size()) && piece[static_cast<std::size_t>(guard)];
    return is_force ? mesh_error_of_forces : mesh_error;
  }

  double localisation = 1e-12;           ///< bracket of an event as a part of its step
  std::optional<double> lambda_scale{};  ///< λ₀ of the metric, where the branch's start has none; else by its tangent
  int max_points = 5000;
  bool every_direction = false;  ///< report a change of contacts that several directions leave as a branch point also
                                 ///< where one of them alone is stable
  std::function<void(const StepAttempt&)> ledger{};  ///< is told of every attempted step
  MakeFactorization factorization = make_ldlt;       ///< makes what stiffness matrices are factorized by
  bool stay = false;  ///< where only unstable directions leave a change of contacts: keep the old contacts if one does
};

/// A monitor whose turning points are events.
struct Watch {
  std::shared_ptr<const Observable> quantity{};
  std::string label{};
};

/// A branch point that another branch passes through.
struct KnownPoint {
  State state{};
  int branch = 0;
};

/// The beginning of a branch that leaves a pitchfork in a corner (BranchPoint::at_corner). At the corner itself, where
/// its new part has no length, K is singular, so that no step begins there.
struct EnteredBranch {
  State begin{};          ///< an equilibrium near the corner; the part may be shorter there than its bound allows
  Direction tangent{};    ///< there, away from the corner, of unit length
  State first{};          ///< the first equilibrium behind it at which all guards hold
  double distance = 0.0;  ///< at which the branch was entered, along the mode [path metric]
};

/// Where a branch begins: at a state alone, forward with λ or against it; or at a branch point, along one of its
/// tangents; or at a corner, behind which it was entered.
struct BranchStart {
  State state{};
  int sense = 1;                           ///< of a state alone: −1 against StepOptions::first
  std::optional<Direction> forward{};      ///< unit tangent at a branch point
  std::optional<EnteredBranch> entered{};  ///< behind a corner
  Direction mode{};                        ///< the first step keeps its component along this
  double distance = 0.02;                  ///< of the first step off a branch point [path metric]
  std::optional<Index> unstable{};         ///< of the branch point
  std::optional<double> lambda_scale{};    ///< of the metric, as on the branches before
  std::vector<KnownPoint> known{};         ///< branch points where this branch would join another
};

}  // namespace arcwall
