#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "continuation/corners/outgoing_directions.hpp"
#include "continuation/corners/visited_corner.hpp"
#include "continuation/trace_tools.hpp"

namespace arcwall {

/// A change of contacts that is passed, to be remembered among those visited.
struct CornerVisit {
  std::size_t which = 0;   ///< of the places visited before; their number for a new one
  VisitedCorner corner{};  ///< with the ways that come to those known
};

void remember(std::vector<VisitedCorner>& visited, CornerVisit visit);

/// The outgoing direction that is taken.
struct ChosenDirection {
  OutgoingDirection taken{};
  std::optional<Index> unstable{};           ///< negative eigenvalues along it, if there was a choice
  std::vector<OutgoingDirection> untaken{};  ///< each begins a branch of its own
};

/// A choice, or why there is none; either way what is to be remembered of the place.
struct Choice {
  std::variant<ChosenDirection, BranchEnd> result{};
  CornerVisit visit{};
};

/// Of the directions that were not taken before: the stable one; of several the one along which λ goes on, where the
/// path arrives stable, and then the one nearest the incoming direction; if none is stable, the one with fewest
/// unstable directions that leaves the old active set (docs/theory.md, section 4). `at` is the place as it was reached,
/// `before` the count just before it. Where all are taken the path is a closed loop, unless it has not moved since
/// it was there.
Choice choose(TraceTools& tools, const std::vector<VisitedCorner>& visited, std::vector<OutgoingDirection> ways,
              const PathPoint& at, const StabilityCount& before, double lambda_scale);

/// The contacts that hold along a direction: those with a force, and those that get one.
ActiveSet holding_along(const TraceTools& tools, const OutgoingDirection& way, const State& corner);

/// Negative eigenvalues along a direction.
std::optional<Index> count_along(TraceTools& tools, const OutgoingDirection& way, const State& corner);

}  // namespace arcwall
