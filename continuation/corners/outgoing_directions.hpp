#pragma once

#include <vector>

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

/// One way on from a corner.
struct Ray {
  Piece piece{};          ///< contacts closed along it; those that neither load nor open keep the status they had
  Direction direction{};  ///< of any length, in the unknowns of `piece`
  Piece loading{};        ///< degenerate contacts whose force grows along it
};

/// How exactly rates are told from zero, relative to the greatest rate of their kind.
struct CornerOptions {
  double rate_tolerance = 1e-7;
  double same_direction = 1e-8;  ///< 1 − cosine below which two rays are one
  int max_enumerated = 12;       ///< degenerate contacts up to which all subsets are tried
};

/// The matrix of a corner and its factorization, kept from corner to corner.
struct CornerWorkspace {
  Linearization equations{};
  BorderedSolver solver{};
};

/// All directions that leave a corner, by the rate complementarity problem of docs/theory.md, section 4:
///
///     0 ≤ ṗ  ⊥  λ̇ a + M ṗ ≥ 0
///
/// `degenerate` are the contacts whose gap and force are both zero there. The ray along which the corner was reached
/// (backwards) is among them. Empty where K with all degenerate contacts open is singular. `workspace` leaves no trace
/// in the result.
std::vector<Ray> rays_of(const System& system, const State& corner, const std::vector<Index>& degenerate,
                         const CornerOptions& options, CornerWorkspace& workspace);

}  // namespace arcwall
