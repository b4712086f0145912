#pragma once

#include <memory>

#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// CHOLMOD's simplicial LDLᵀ, for indefinite matrices of any pattern. The last `multipliers` unknowns are each
/// eliminated right after the last unknown that they touch.
std::unique_ptr<SymmetricFactors> simplicial_ldlt(const SparseMatrix& lower_triangle, Index multipliers);

}  // namespace arcwall
