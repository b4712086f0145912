#pragma once

#include <optional>
#include <vector>

#include "continuation/trace_tools.hpp"

/// The first point of an active set behind a bound, where a change of contact or of the mesh leads on.
namespace arcwall {

/// Whether there is an active set behind, or only a reason to end.
bool leads_on(Transition::Change change);

/// Whether the first point on the active set ahead lies a little beyond the bound, with a new stretch of some length.
bool begins_with_length(const Transition& transition);

/// Whether it is the point at the bound itself, at which a new zone has no length.
bool begins_without_length(const Transition& transition);

/// Whether behind a bound there is the same active set on another mesh: a state beyond it is none the worse.
bool is_of_mesh(const System& system, const State& state, const Direction& forward, Index guard, double slack);

/// Where an active set begins, as far as it is followed back from its first point.
struct Beginning {
  PathPoint at;
  bool ends_there = false;  ///< nearer the bound the active set does not hold
};

/// A transition and the first point behind it; where its active set begins before that, with a span that is shorter.
struct Entered {
  const Transition* transition;
  PathPoint at;
  std::optional<Beginning> begin{};
  std::vector<Strategy> strategies{};  ///< beyond the first transition with its own length
};

/// Where an active set begins whose first point has a new span of some length: it is followed back towards spans of no
/// length as long as it is followed surely, and holds, to a sixteenth; of shorter spans neither forces nor counts are
/// sure. Where a value that is met nowhere else or a wall comes before that, it is followed farther. So the first point
/// is reached by a step like any other.
Beginning begin_of(TraceTools& tools, const Transition& transition, const PathPoint& first, const PathPoint& from,
                   double lambda_scale);

/// The first point of the active set behind a transition, with its count. Empty if none is found.
std::optional<PathPoint> enter(TraceTools& tools, const Transition& transition, const PathPoint& from,
                               double lambda_scale, Effort effort = Effort::usual);

/// Whether no wall is passed on the way from one state to another, nor entered at its end.
bool is_clear(const TraceTools& tools, const State& from, const State& to);

/// Whether the side conditions hold at the first point of an active set, but for bounds of its mesh.
bool holds_at(const TraceTools& tools, const PathPoint& at);

/// By how much λ of a change that is known on the active set ahead by a quantity differs where it is sought from
/// beside: what round-off makes of the forces, and with them of the quantity. 0 of other changes.
double scatter_of(TraceTools& tools, const Entered& entered, double lambda_scale);

/// The first of the transitions behind which a point is found that does not lie back. One that is not found with its
/// length is entered early before those that come after it: what begins at the corner comes before what is farther off.
/// Where none is found, they are entered with parts of their lengths; then all are tried again with patience. Last
/// comes what is not sure to hold ahead, or does not hold between there and the bound, or has a count
/// against which λ does not turn: with its length there may be a second equilibrium behind the next fold, from which
/// the path would come back; and at a pitchfork in the corner the count is right.
std::optional<Entered> enter_any(TraceTools& tools, const std::vector<Transition>& transitions, const PathPoint& from,
                                 const StabilityCount& before, double lambda_scale);

}  // namespace arcwall
