#pragma once

#include <optional>

#include "continuation/trace_tools.hpp"

namespace arcwall {

/// A place that an arc passes and the branches have passed before, and how the branch ends there.
struct KnownPlace {
  State state{};
  BranchEnd end{};
};

/// The start of the branch, or a branch point of another one, if the arc from the step's origin to `to` passes it.
std::optional<KnownPlace> passed_known_place(TraceTools& tools, const StepOrigin& origin, const PathPoint& to);

}  // namespace arcwall
