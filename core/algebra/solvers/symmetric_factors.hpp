#pragma once

#include "core/algebra/factorization.hpp"
#include "core/ground_term.hpp"

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

/// L D Lᵀ of the symmetric matrices of one pattern, by one of the ways that Ldlt chooses among.
class SymmetricFactors {
 public:
  virtual ~SymmetricFactors() = default;

  /// The lower triangle of a matrix with the pattern analysed, its entries finite, and which parts of them are ground
  /// terms, for who can use that. False if a pivot is zero or not finite, or the matrix is none that this way serves.
  virtual bool factorize(const SparseMatrix& lower_triangle, GroundTerms ground = {}) = 0;

  /// Lets the analysis serve a pattern that differs from the last one in its multipliers alone, its last unknowns;
  /// false where that needs another one.
  virtual bool reuse_analysis(const SparseMatrix&, Index) { return false; }

  /// Whether entries may be other than finite: then no pivot is spared from them, and factorize() is false.
  virtual bool sees_what_is_not_finite() const { return false; }

  /// Where factorize() was false: whether another way may serve that matrix.
  virtual bool refused() const { return false; }

  /// X := A⁻¹ X.
  virtual void solve(Eigen::Ref<Matrix> X) const = 0;

  virtual Pivots pivots() const = 0;

  /// The greatest pivot over the greatest entry of the matrix that was factorized: digits are lost where it is large.
  virtual double growth(const SparseMatrix& lower_triangle) const {
    return pivots().greatest /
           Eigen::Map<const Vector>(lower_triangle.valuePtr(), lower_triangle.nonZeros()).cwiseAbs().maxCoeff();
  }

  /// |v|ᵀ |L| |D| |L|ᵀ |v|
  virtual double weighted(const Eigen::Ref<const Vector>& v) const = 0;

  /// Columns that the matrices to come hardly resist, as far as one knows.
  virtual void expect_near_null(const Matrix&) {}

  /// Whether these may be of use, now or with other multipliers.
  virtual bool may_use_near_null() const { return true; }
};

}  // namespace arcwall
