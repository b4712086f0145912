#pragma once

#include <optional>

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

/// How many eigenvalues of K + N have a negative real part, in unknowns whose diagonal is scaled to 1: directions in
/// which a slow motion grows while what slips goes on to slip. Empty where factorizations fail. `solver` has factorized
/// `equations`, which have an N and no multipliers.
std::optional<Index> negative_real_parts(const BorderedSolver& solver, const Linearization& equations);

/// Whether no motion releases energy in the first order, whatever slips on or sticks (Hill's condition): the symmetric
/// part of K + N is positive definite, less the work that is lost. `equations` have an N.
bool work_is_positive(const BorderedSolver& solver, const Linearization& equations);

}  // namespace arcwall
