#pragma once

#include <vector>

#include "continuation/corners/corner_options.hpp"
#include "core/algebra/bordered_solver.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// One way on from a change of contacts.
struct OutgoingDirection {
  ActiveSet active_set{};   ///< contacts closed along it; those that neither load nor open keep the status they had
  Direction direction{};    ///< of any length, in the unknowns of `active_set`
  ActiveSet loading{};      ///< degenerate contacts whose force grows along it
  double wrong_rate = 0.0;  ///< the greatest rate of the wrong sign, over the one that counts as zero; at most 1
};

/// The matrix of a corner and its factorization, kept from corner to corner.
struct CornerWorkspace {
  Linearization equations{};
  BorderedSolver solver{};
};

/// All directions along which equilibria leave a change of contacts, by the rate complementarity problem of
/// docs/theory.md, section 4:
///
///     0 ≤ ṗ  ⊥  λ̇ a + M ṗ ≥ 0
///
/// `degenerate` are the contacts whose gap and force are both zero there. The direction by which the place was reached
/// (backwards) is among them. Where K with all degenerate contacts open is singular, or all but singular, the rate of
/// one of their gaps stands in the place of that of λ; with max_enumerated = 0 each active set is asked by itself. Of
/// active sets that move the structure alike the one whose rates are wrong by the least is told.
/// `workspace` leaves no trace in the result.
std::vector<OutgoingDirection> outgoing_directions(const UnilateralSystem& system, const State& corner,
                                                   const std::vector<Index>& degenerate, const CornerOptions& options,
                                                   CornerWorkspace& workspace);

}  // namespace arcwall
