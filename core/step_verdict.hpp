#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/transition.hpp"

namespace arcwall {

/// A step between two equilibria with one active set.
struct CheckedStep {
  /// The end of a step in which all guards are ≥ 0.
  struct LocatedEnd {
    double penetration = 0.0;         ///< that is accepted between contacts [scale of guards]
    double gap_seen = -penetration;   ///< gaps between contacts below it need guards [scale of guards]
    std::optional<Index> guard{};     ///< that vanishes there
    const Direction* from = nullptr;  ///< direction of the path at the step's start; null: no restarts are wanted
    bool turns = false;               ///< λ runs the other way there than at the start
  };

  const State& from;
  const State& to;
  std::optional<LocatedEnd> located{};  ///< empty: where the corrector converged; guards may be violated
};

/// What a system says about a step beyond its guards: the step is accepted, repeated from its start with another
/// layout, or rejected.
struct StepVerdict {
  enum class Fault {
    none,
    wall_left,     ///< a closed contact is beyond the end of its wall
    behind_end,    ///< the structure entered a wall from beyond its end, where it has no contact surface
    wall_crossed,  ///< the structure would pass through a wall between the two states
    penetration,   ///< the structure penetrates a wall between the contacts
    blocked,       ///< a wall would enter a place that supports hold
  };
  /// Layouts at the step's start with guards for what happens in it, or with a mesh that fits the located guard. The
  /// step is repeated with the first that passes through its start. If there is none, `fault` counts.
  std::vector<Transition> restarts{};
  Fault fault = Fault::none;
  std::string place{};  ///< of the fault, `floor at beam:0.4`; may be empty
};

}  // namespace arcwall
