#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "continuation/corners/choice.hpp"
#include "continuation/events/value_point.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// A point at which guards are zero, and what is known of the path just before it.
struct Corner {
  PathPoint at{};
  double slack = 0.0;          ///< by how much other guards are violated: those within it belong to the change
  std::vector<int> signs{};    ///< of the detectors, before
  StabilityCount before{};     ///< the count, before
  double lambda_scale = 1.0;   ///< of the path metric
  int without_progress = 0;    ///< changes of contacts in a row at this place
  bool begins_branch = false;  ///< the branch begins here: nothing has turned before
};

/// Why a path ends where none of the ways that it may take behind a corner has a point.
inline constexpr std::string_view nothing_behind_change = "beyond a change of contact";

/// An active set that was entered behind a transition that makes a span: its first point has one of some length.
struct EnteredActiveSet {
  PathPoint
      begin{};  ///< on the same active set with a small part of that length: where the step to the first point begins
  std::optional<PathPoint> first{};  ///< empty: it only tells where the active set leads, and does not hold itself
  std::vector<ValuePoint> values{};  ///< between the corner and `begin`, in their order
};

/// Where a corner leads.
struct CornerPassed {
  PathPoint at{};  ///< the same place on the active set ahead; behind, if the active set begins with a span
  std::optional<EnteredActiveSet> entered{};  ///< that begins with a span
  std::vector<int> signs{};                   ///< of the detectors' values ahead
  std::vector<Event> events{};                ///< at `at`
  std::optional<BranchEnd> end{};             ///< why nothing can be followed, where that is so
  std::optional<CornerVisit> visit{};         ///< to be remembered
  int without_progress = 0;
  std::vector<Strategy> strategies{};  ///< that led there

  /// The nearest point known of the active set ahead.
  const PathPoint& ahead() const { return entered ? entered->begin : at; }
};

/// Leaves a corner where contacts close or open, by one of its outgoing directions. `landed`: the guard that was landed
/// on, if one was.
CornerPassed turn_corner(TraceTools& tools, Corner corner, std::optional<Index> landed,
                         const std::vector<VisitedCorner>& visited);

/// Passes a validity bound of an active set (spreading, gathering, …), `bound` among its guards.
CornerPassed pass_bound(TraceTools& tools, Corner corner, Index bound);

/// The lowest of the validity bounds that a point has passed, if one has been. Bounds of friction are none of them. A
/// span that has just begun may still be shorter than its bound, and grows: that one is not passed.
std::optional<Index> bound_passed_at(const System& system, const PathPoint& at, double tolerance);

/// Whether a guard of an active set is that of a stick, μ p − |T| ≥ 0: behind it contacts change, not unknowns.
bool is_friction_bound(const System& system, const ActiveSet& active_set, Index guard);

/// Returns the signs of the detectors' values behind a corner that one way leaves. Where the counts exclude that λ
/// turns there, λ′ of another sign is round-off, and the sign is that of before.
std::vector<int> signs_behind_corner(const TraceTools& tools, const Corner& corner, const PathPoint& behind);

/// λ or a monitor turns between the signs before a corner and behind it: an event each, like `event`.
void add_turns(const TraceTools& tools, const std::vector<int>& before, const std::vector<int>& behind, Event event,
               std::vector<Event>& events);

}  // namespace arcwall
