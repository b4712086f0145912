#pragma once

#include "core/algebra/factorization.hpp"

namespace arcwall {

/// Signs and magnitudes of pivots.
struct Pivots {
  Inertia signs{};
  double least = infinity, greatest = 0.0;  ///< in magnitude

  /// False for a pivot that is zero or not finite.
  bool add(double pivot);

  /// Those of another part.
  void add(const Pivots& others);
};

/// L D Lᵀ of the symmetric matrices of one pattern, by one of the ways that Ldlt chooses among. `singular` also where a
/// pivot is zero though the matrix is regular.
class SymmetricFactors : public Factorization {
 public:
  /// Lets the analysis serve a pattern that differs from the last one in its multipliers alone, its last unknowns;
  /// false where that needs another one.
  virtual bool reuse_analysis(const SparseMatrix&, Index) { return false; }

  /// Where a matrix was called singular: whether another way may serve it.
  virtual bool refused() const { return false; }

  /// Now, or with other multipliers.
  bool may_use_near_null() const override { return true; }

  /// Of the last matrix, if that was factorized.
  const Pivots& pivots() const { return pivots_; }

  std::optional<Inertia> inertia() const final { return pivots_.signs; }
  double pivot_ratio() const final { return pivots_.least / pivots_.greatest; }
  double growth(const SparseMatrix& lower_triangle) const final;

  /// ε times |v|ᵀ |L| |D| |L|ᵀ |v|. Wilkinson: K + E = L D Lᵀ with |E| ≤ γ |L| |D| |L|ᵀ. Without pivoting L may grow;
  /// |K| alone would not show it.
  double roundoff(const Eigen::Ref<const Vector>& v) const final;
  virtual double weighted(const Eigen::Ref<const Vector>& v) const = 0;  ///< |v|ᵀ |L| |D| |L|ᵀ |v|

 protected:
  static bool is_finite(const SparseMatrix& A);

  Pivots pivots_;
};

}  // namespace arcwall
