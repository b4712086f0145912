#pragma once

#include "core/state.hpp"

namespace arcwall {

/// Internal variables that equations take from the way to a state, as the slips of points that elastic friction holds
/// (UnilateralSystem::history()). They are constants of an active set's layout. A step is solved with those of its
/// start, and an accepted point has its own from then on.
class PathHistory {
 public:
  virtual ~PathHistory() = default;

  /// Returns an accepted point with the internal variables that it has now: the same equilibrium. `arrives`: the path's
  /// direction there, `length`: of the step, both in the path metric.
  virtual State committed(const State& state, const Direction& arrives, double length) const = 0;

  struct Leaving {
    State state{};
    bool has_changed = false;  ///< what slips, and with it the direction in which the path goes on
  };
  /// Returns a committed point with what slips where the path goes on along a direction: of the points at their bound
  /// of friction those that the direction drives over it. `one`: of what changes the first alone.
  virtual Leaving leaving(const State& state, const Direction& direction, bool one) const = 0;
};

}  // namespace arcwall
