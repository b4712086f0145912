#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/stability_count.hpp"
#include "core/eigenpairs.hpp"
#include "core/state.hpp"
#include "core/transition.hpp"

namespace arcwall {

/// A converged point of a path.
struct PathPoint {
  State state{};
  Direction tangent{};                          ///< of unit length, forward along the path
  double arc = 0.0;                             ///< arc length from the branch's first point [path metric]
  std::optional<Index> negative_eigenvalues{};  ///< with all closed contacts held; empty: one is zero within round-off
  StabilityCount count{};
  NearNull nearest{};      ///< estimates of the eigenpairs nearest zero, at most two; none at singular points
  int iterations = 0;      ///< of the step that led here
  double residual = 0.0;   ///< relative
  double unsettled = 0.0;  ///< how far round-off lets the corrector move it; 0 where it settled [path metric]
  Vector guards{};         ///< in the scale of System::guards
  Vector guard_rates{};    ///< along the tangent
};

enum class EventKind {
  start,
  end,
  contact_closes,
  contact_opens,
  contact_spreads,    ///< a contact point becomes a contact zone
  contact_splits,     ///< a contact point or zone becomes two contacts with a free span between
  contact_shrinks,    ///< a contact zone becomes a contact point
  contacts_merge,     ///< two contacts become one
  contact_transfers,  ///< contact moves between the end and the inside of a member, or over a joint
  limit_point,
  contact_limit_point,
  turning_point,  ///< of a monitor
  branch_point,
  user,  ///< of a detector that the program added
};

/// Which way λ turns at a limit point.
enum class Extremum { maximum, minimum };

/// How branches cross.
enum class BranchType {
  pitchfork,      ///< the other branch leaves along the mode, both sides alike at first order
  transcritical,  ///< both branches pass through the point, and λ turns on neither
  one_sided,      ///< several directions leave a change of contacts
  multiple,       ///< several modes at one place, or none that is known
};

/// A point where several branches meet.
struct BranchPoint {
  /// A one-sided way on: the contacts closed along it and its unit direction in the unknowns of that piece.
  struct Way {
    Piece piece{};
    Direction direction{};
  };

  BranchType type = BranchType::pitchfork;
  State state{};
  Direction along{};                ///< unit tangent of the branch it was found on, forward
  Direction mode{};                 ///< critical mode, of unit length, first largest component positive; no λ
  std::vector<Direction> modes{};   ///< all critical modes, `mode` the first
  Direction other{};                ///< unit tangent of the other branch
  std::vector<Way> ways{};          ///< of a one-sided branch point: those not taken; `mode` and `other` stay empty. Of
                                    ///< a pitchfork that is met along its own branch: both along the other one
  Index multiplicity = 1;           ///< of the zero eigenvalue
  Index change = 0;                 ///< of the number of negative eigenvalues across it
  double lambda_uncertainty = 0.0;  ///< half-width in λ of what is left uncertain
  bool mesh_artefact = false;       ///< contacts tied to nodes make it: the continuum has none
  bool at_corner = false;           ///< its branches begin with a part that has no length there: `state` is a little
                                    ///< behind it, on the path

  /// A pitchfork that the path comes to along the branch that bifurcates: beyond it lies the path's mirror image.
  bool ends_its_own_branch() const { return type == BranchType::pitchfork && !ways.empty(); }
};

/// A located point of a path.
struct Event {
  EventKind kind = EventKind::start;
  std::string label{};  ///< which monitor turns; why the branch ends
  State state{};        ///< on the piece of `guards`; the arc's end may be the same place on another mesh
  double arc = 0.0;
  double residual = 0.0;            ///< relative
  double lambda_uncertainty = 0.0;  ///< half-width in λ of what is left uncertain
  bool unconfirmed = false;         ///< zero is touched without a change of sign, as nearly as can be told
  std::optional<Index> unstable_before{}, unstable_after{};
  std::optional<Extremum> extremum{};              ///< of λ, where it turns
  std::vector<Index> guards{};                     ///< contacts that change
  std::optional<Continuum> continuum{};            ///< of which the path keeps to one member from here on
  std::shared_ptr<const BranchPoint> branching{};  ///< of branch points
};

/// Why a branch ended.
enum class EndReason {
  stop,             ///< a bound of the deck was met
  closed_loop,      ///< it came back to a point it had passed
  reached_branch,   ///< it reached a branch point of another branch
  switched_branch,  ///< the path goes on along a bifurcated branch
  max_points,
  max_time,
  interrupted,
  min_step,  ///< no step above the least length succeeds
  singular,  ///< the equations are singular where they should not be
  not_finite,
  no_continuation,     ///< no equilibrium leaves a change of contacts
  control_turns,       ///< the controlled quantity turns
  wall_end,            ///< a contact reached the end of its wall
  equilibrium_family,  ///< a continuum of equilibria with one load and energy lies ahead
  not_modelled,        ///< something lies ahead that is not modelled
  rigid_body_motion,   ///< a body that nothing holds was pushed away
};

/// How a branch ended.
struct BranchEnd {
  EndReason reason = EndReason::stop;
  std::string detail{};          ///< which bound; what to try
  std::optional<int> partner{};  ///< the branch that it joined or that goes on
  std::optional<Continuum> continuum{};
};

/// One accepted stretch of path and the events at its end. The first arc of a branch has length zero.
struct Arc {
  PathPoint to{};
  std::vector<Event> events{};
};

}  // namespace arcwall
