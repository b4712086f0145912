#pragma once

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

/// The slip stiffness D_ij = −∂(|T_i| − μ p_i)/∂y_j of contacts that slip, y ≥ 0 the slip of each in its own sense, all
/// else in equilibrium at constant λ: by how much slip that goes on takes from what drives it. `solver` has factorized
/// `equations`, K being regular. Of the border's other equations all hold.
Matrix slip_stiffness(const BorderedSolver& solver, const Linearization& equations);

/// The number of negative real eigenvalues.
Index negative_real_eigenvalues(const Matrix& D);

enum class SlipStability {
  stable,     ///< no slip releases energy: the symmetric part of D is positive definite
  unstable,   ///< a slip starts by itself: 0 ≤ y ⊥ (D + α I) y ≥ 0 for some α > 0 and y ≠ 0
  undecided,  ///< neither was found
};

SlipStability slip_stability(const Matrix& D);

}  // namespace arcwall
