#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/stability_count.hpp"
#include "core/contact_mode.hpp"
#include "core/eigenpairs.hpp"
#include "core/state.hpp"
#include "core/transition.hpp"

namespace arcwall {

/// Stores a converged point of an equilibrium path.
struct PathPoint {
  State state{};
  Direction tangent{};                          ///< unit tangent, forward along the path
  double arc = 0.0;                             ///< arc length from the branch's first point [path metric]
  std::optional<Index> negative_eigenvalues{};  ///< of K with all closed contacts; empty: K is singular to round-off
  StabilityCount count{};
  NearNull nearest{};      ///< estimates of the eigenpairs nearest zero, at most two; none at singular points
  int iterations = 0;      ///< of the corrector
  double residual = 0.0;   ///< relative residual [-]
  double unsettled = 0.0;  ///< corrections due to round-off; 0 if the corrector converged [path metric]
  Vector guards{};         ///< see UnilateralSystem::guards() [-]
  Vector guard_rates{};    ///< along the tangent
};

/// Kinds of events; to_text() in model/event_names.hpp returns their names.
enum class EventKind {
  start,
  end,
  contact_closes,
  contact_opens,
  contact_spreads,    ///< a contact point becomes a contact zone
  contact_splits,     ///< a contact point or zone becomes two contacts with a free span between
  contact_shrinks,    ///< a contact zone becomes a contact point
  contacts_merge,     ///< two contacts become one
  contact_slips,      ///< a contact that stuck by friction begins to slip
  contact_sticks,     ///< the slip of a contact ends
  contact_transfers,  ///< contact moves between the end and the inside of a member, or over a joint
  limit_point,
  contact_limit_point,
  turning_point,   ///< of a monitor
  value_crossing,  ///< a monitor or λ passes a value
  reversal,        ///< λ turns since the deck says so
  branch_point,
  user,  ///< of a detector that the program added
};

/// Returns true if contacts change at such an event.
constexpr bool changes_contact(EventKind kind) {
  switch (kind) {
    case EventKind::contact_closes:
    case EventKind::contact_opens:
    case EventKind::contact_spreads:
    case EventKind::contact_splits:
    case EventKind::contact_shrinks:
    case EventKind::contacts_merge:
    case EventKind::contact_slips:
    case EventKind::contact_sticks:
    case EventKind::contact_transfers:
      return true;
    case EventKind::start:
    case EventKind::end:
    case EventKind::limit_point:
    case EventKind::contact_limit_point:
    case EventKind::turning_point:
    case EventKind::value_crossing:
    case EventKind::reversal:
    case EventKind::branch_point:
    case EventKind::user:
      break;
  }
  return false;
}

/// Type of extremum of λ at a limit point.
enum class Extremum { maximum, minimum };

/// Type of a bifurcation.
enum class BranchType {
  pitchfork,      ///< the other branch leaves along the mode, symmetric to first order
  transcritical,  ///< both branches pass through the point, and λ is monotone on both
  one_sided,      ///< non-smooth: an active-set change with several outgoing directions
  multiple,       ///< several critical modes, or no known mode
};

/// Stores a bifurcation point.
struct BranchPoint {
  /// Stores an outgoing direction at an active-set change: its active set, and the unit direction in these unknowns.
  struct Way {
    ActiveSet active_set{};
    Direction direction{};
  };

  BranchType type = BranchType::pitchfork;
  State state{};
  Direction along{};                ///< forward unit tangent of the traced branch
  Direction mode{};                 ///< critical mode of unit length, first largest component positive; dlambda = 0
  std::vector<Direction> modes{};   ///< all critical modes, `mode` the first
  Direction other{};                ///< unit tangent of the other branch
  std::vector<Way> ways{};          ///< one_sided: outgoing directions not taken; `mode` and `other` are then empty.
                                    ///< Pitchfork reached along its own branch: both directions of the other branch
  Index multiplicity = 1;           ///< of the zero eigenvalue
  Index change = 0;                 ///< of the number of negative eigenvalues across the point
  double lambda_uncertainty = 0.0;  ///< half-width in λ
  bool mesh_artefact = false;       ///< due to contact at nodes; absent in the continuous problem
  bool at_corner = false;  ///< its branches start with a contact zone of length 0; `state` lies on the path just
                           ///< after the point

  /// Returns true if the path reached a pitchfork along the bifurcated branch; its continuation is its mirror image.
  bool ends_its_own_branch() const { return type == BranchType::pitchfork && !ways.empty(); }
};

/// Stores an admissible way on from a change of contacts with friction.
struct FrictionWay {
  std::vector<ModeOfContact> modes{};  ///< of the contacts that may change
  int lambda_sense = 0;                ///< sign of the rate of λ
  double dissipation = 0.0;            ///< power of friction along the unit tangent, ≥ 0 [force·length]
  std::optional<Index> unstable{};
  bool taken = false;
};

/// Stores a located event of a path.
struct Event {
  EventKind kind = EventKind::start;
  std::string label{};    ///< name of the monitor; reason of the end
  State state{};          ///< has the active set of `guards`; the arc's end may be the same point on another mesh
  double arc = 0.0;       ///< arc length from the branch's first point [path metric]
  double residual = 0.0;  ///< relative residual [-]
  double lambda_uncertainty = 0.0;                           ///< half-width in λ; 0 for events that are solved for
  bool unconfirmed = false;                                  ///< a zero without a detected change of sign
  std::optional<Index> unstable_before{}, unstable_after{};  ///< unstable directions; empty: unknown
  std::optional<Extremum> extremum{};                        ///< of λ, at limit points
  std::vector<Index> guards{};                               ///< contacts that change
  std::optional<double> value{};                             ///< that is passed at a value crossing
  std::optional<Continuum> continuum{};            ///< equilibrium family of which the path follows one from here on
  std::shared_ptr<const BranchPoint> branching{};  ///< of branch points; else null
  std::vector<FrictionWay> friction_ways{};        ///< all that were found, at a change of contacts with friction
  bool all_ways_known = false;                     ///< every combination of modes was tried
};

/// Reasons of the end of a branch.
enum class EndReason {
  stop,             ///< a stop bound was reached
  closed_loop,      ///< the branch returned to one of its points
  reached_branch,   ///< the branch reached a branch point of another branch
  switched_branch,  ///< the path continues on a bifurcated branch
  jumped,           ///< the structure jumped at constant λ, and another branch begins where it came to rest
  max_points,
  max_time,
  interrupted,
  min_step,  ///< no step longer than StepOptions::min converged
  singular,  ///< the equations are singular at a regular point
  not_finite,
  no_continuation,     ///< no equilibrium continues beyond an active-set change
  control_turns,       ///< the controlled quantity reached a turning point
  wall_end,            ///< a contact reached the end of its wall
  equilibrium_family,  ///< a family of equilibria with one load and energy follows
  not_modelled,        ///< a contact configuration follows that is not modelled
  rigid_body_motion,   ///< an unconstrained body moved away
  jammed,              ///< friction or a support in the way of a wall lets no motion continue the path
  unstable,            ///< the structure lost its stability, and no state after a jump is known
};

/// Stores the end of a branch.
struct BranchEnd {
  EndReason reason = EndReason::stop;
  std::string detail{};                  ///< the bound; the cure
  std::optional<int> partner{};          ///< branch that was reached, or that continues the path
  std::optional<Continuum> continuum{};  ///< of equilibrium_family
};

/// Stores a state of a path and the forward unit tangent there.
struct PathTangent {
  State state{};
  Direction tangent{};
};

/// Stores one accepted step and the events at its end. The first arc of a branch has length zero.
struct Arc {
  PathPoint to{};
  std::vector<Event> events{};
  std::optional<PathTangent> arrives{};  ///< its end on the active set along which it runs; empty: `to` has that one
};

}  // namespace arcwall
