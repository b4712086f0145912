#pragma once

#include "contact/sliding_contact.hpp"
#include "tests/support/branch.hpp"

namespace arcwall::test {

/// What is looked at beyond the defaults.
struct InvariantOptions {
  int recount_every = 1;  ///< every how many points the unstable count is recomputed with dense matrices
};

/// What every branch must fulfil, whatever the system (each violation fails the test once, with its place):
///
/// - F = 0 to what the corrector's tolerance and the round-off of the unknowns leave;
/// - gaps and contact forces ≥ 0 and complementary, to the tracer's guard tolerance;
/// - the stored unstable count equals the dense one, except next to a singular point;
/// - arc length increases, and a step is no longer than allowed;
/// - a located limit point is a maximum or minimum of λ among its neighbours, within its bracket;
/// - contacts that an event says to have changed have changed.
void expect_branch_invariants(const System& system, const Branch& branch, const TraceOptions& options,
                              const InvariantOptions& what = {});

/// What every branch with sliding contact must fulfil at each point:
///
/// - F = 0 to what the corrector's tolerance and the round-off of the unknowns leave, moments of closed points
/// included;
/// - contact forces and all other guards ≥ 0, to the tracer's guard tolerance;
/// - no obstacle is entered at 20 places an element;
/// - the stored unstable count equals the dense one, except next to a singular point or a corner;
/// - arc length increases.
void expect_sliding_invariants(const SlidingContact& system, const std::vector<Arc>& arcs, const TraceOptions& options,
                               double lambda_scale, const InvariantOptions& what = {});

}  // namespace arcwall::test
