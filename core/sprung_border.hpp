#pragma once

#include <vector>

#include "core/factorization.hpp"

namespace arcwall {

/// K where unknowns y_k that hold the body are let go against springs: y_k is c_k times the motion that it held. K with
/// −1/c_k on the diagonal at y_k; free where c_k = 0, as it is where c_k is infinite.
class SprungBorder {
 public:
  /// `inner`: the factorization of K, which is regular. Both must outlive this. `holding`: the y_k; `springs`: c_k ≥ 0.
  SprungBorder(const Factorization& inner, const SparseMatrix& lower_triangle, const std::vector<Index>& holding,
               const Vector& springs);

  /// False where K is singular to working precision; then nothing else may be asked.
  bool is_finite() const;

  /// How many more directions have negative energy than with all y_k holding.
  Index negative() const;

  /// The lower triangle of K.
  const SparseMatrix& matrix() const { return K_; }

  /// The y_k that are let go.
  const std::vector<Index>& released() const { return released_; }

  /// Solutions in place.
  void solve(Eigen::Ref<Matrix> X) const;

  /// Of columns that solve() gave, or combinations of them.
  Matrix product(const Matrix& X) const;

 private:
  const Factorization& inner_;
  const SparseMatrix& K_;
  std::vector<Index> released_;
  Matrix moved_;       // K⁻¹ E, E the unit columns of what is let go
  Matrix resistance_;  // S + diag c
};

}  // namespace arcwall
