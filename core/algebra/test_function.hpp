#pragma once

#include <cmath>
#include <optional>

#include "core/algebra/factorization.hpp"
#include "core/algebra/near_null.hpp"
#include "core/algebra/quadratic_form.hpp"

namespace arcwall {

/// ψ of a symmetric matrix K, whose signs are those of −K near singularity:
///
///     [ K   B ] [V]   [0]
///     [ Bᵀ  0 ] [Ψ] = [1],      Ψ = −Vᵀ K V                                                         (Govaerts 2000)
///
/// B has a column for each eigenvalue near zero, any vectors that are not normal to the eigenvectors. The bordered
/// matrix is regular where K is singular, V turns into the null space there and Ψ passes zero smoothly.
class BorderedTestFunction {
 public:
  /// By LU of the whole with pivoting; empty if the bordered matrix is singular.
  static std::optional<BorderedTestFunction> of(const SparseMatrix& lower_triangle, const Matrix& border);

  const Matrix& psi() const { return psi_; }
  const Matrix& vectors() const { return vectors_; }  ///< V

 private:
  Matrix psi_, vectors_;
};

/// Signs of the eigenvalues of a symmetric matrix.
struct SignCount {
  Index negative = 0;
  Index positive = 0;
  Index undecided = 0;  ///< zero within round-off: a change of K's entries in their last digit may turn them
};

/// The signs where the pivots of an LDLᵀ cannot be trusted. The eigenvalues of K φ = μ W φ in (−σ, σ), few and well
/// inside, are told from the others by the inertia of K ± σ W, which are safely regular, and get their signs from Ψ.
/// `weights`: W, diagonal, zero for the `multipliers` at the end, which count like other unknowns: one negative and one
/// positive eigenvalue each. Empty if that cannot be done: no gap between eigenvalues.
std::optional<SignCount> sign_count_near_singularity(const SparseMatrix& lower_triangle, const Vector& weights,
                                                     Index multipliers, const MakeFactorization& make = make_ldlt);

/// Negative eigenvalues of K by the signs of the pivots, where the eigenvalue nearest zero stands clear of the
/// round-off of the factorization; else empty. `nearest`: the pairs nearest zero, or nearly.
std::optional<Index> negative_by_pivots(const Factorization& factorization, const Vector& weights,
                                        const NearNull& nearest);

/// The same by Ψ where pivots do not tell; empty where an eigenvalue is zero within round-off.
std::optional<Index> negative_count(const Factorization& factorization, const SparseMatrix& lower_triangle,
                                    const Vector& weights, Index multipliers, const NearNull& nearest,
                                    const MakeFactorization& make = make_ldlt);

}  // namespace arcwall
