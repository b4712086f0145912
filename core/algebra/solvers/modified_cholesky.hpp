#pragma once

#include <memory>

#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// CHOLMOD's supernodal LLᵀ, which works by dense blocks and is much faster where many unknowns couple, made to serve
/// matrices with a few negative eigenvalues, too: springs k on single unknowns, with unit vectors for the columns of E,
/// make K̂ = K + E k Eᵀ definite. Then
///
///     K⁻¹ f = x + Y S⁻¹ Eᵀ x,    x = K̂⁻¹ f,    Y = K̂⁻¹ E,    S = k⁻¹ − Eᵀ Y                                   (1)
///
/// and K has as many negative eigenvalues as S (Haynsworth 1968). Springs stand where a soft vector that is expected
/// has most of its energy, and where one has that shows by a pivot that fails: what this vector lacks is only K's own
/// stiffness. A spring holds a point alone, so that some more may be needed than there are negative eigenvalues.
/// Springs stand until other soft vectors are expected.
///
/// Null where this way does not pay: few unknowns, or such that couple with few others. Matrices that need too many
/// springs are refused.
std::unique_ptr<SymmetricFactors> modified_cholesky(const SparseMatrix& lower_triangle);

/// The same, whether it pays or not.
std::unique_ptr<SymmetricFactors> any_modified_cholesky(const SparseMatrix& lower_triangle);

}  // namespace arcwall
