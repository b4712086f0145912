#pragma once

#include <optional>

#include "continuation/metric.hpp"
#include "continuation/path_point.hpp"
#include "continuation/step/corrector.hpp"
#include "continuation/trace_options.hpp"
#include "core/system.hpp"

namespace arcwall {

/// Enters the branch on one side (`sign`) of the mode, `distance` or less from the corner, and follows it to where all
/// guards hold. Empty if no such branch is found.
std::optional<EnteredBranch> enter_branch(const System& system, Corrector& corrector, const Metric& metric,
                                          const BranchPoint& point, int sign, double distance, double guard_tolerance);

}  // namespace arcwall
