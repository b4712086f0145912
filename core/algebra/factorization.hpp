#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/ground_term.hpp"
#include "core/types.hpp"

namespace arcwall {

enum class FactorStatus { ok, singular, not_finite };

/// Signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  Index negative = 0;
  Index positive = 0;
};

/// What is known of a symmetric matrix besides its entries. A factorization may do without it.
struct MatrixProperties {
  Index multipliers = 0;                                ///< that many last unknowns are multipliers: in saddle points
                                                        ///< [K −Gᵀ; −G 0] their diagonal is zero
  const std::vector<bool>* translation_free = nullptr;  ///< as in Linearization, where given
  GroundTerms ground{};                                 ///< as in Linearization
  bool same_pattern = false;  ///< the pattern is the last matrix's, and so is all above but for values
};

/// Factorizes sparse symmetric matrices, indefinite ones included, one after the other. The analysis of a pattern is
/// kept while that stays the same. All solvers get theirs through MakeFactorization, so that a program, a test or a
/// benchmark can put another in its place.
class Factorization {
 public:
  virtual ~Factorization() = default;

  /// A matrix by its lower triangle. After any status but `ok` nothing below may be asked but inertia() and
  /// pivot_ratio().
  virtual FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known) = 0;

  /// X := A⁻¹ X, for any number of columns.
  virtual void solve(Eigen::Ref<Matrix> X) const = 0;

  /// Empty where the last matrix could not be factorized.
  virtual std::optional<Inertia> inertia() const = 0;

  /// Least |pivot| over greatest; small near singularity. 0 where the last matrix could not be factorized.
  virtual double pivot_ratio() const = 0;

  /// Greatest |pivot| over the greatest entry of the matrix that was factorized: much above 1 where a part that was
  /// eliminated before the rest is nearly singular by itself, which costs as many digits.
  virtual double growth(const SparseMatrix& lower_triangle) const = 0;

  /// vᵀ E v at most, up to a small factor, of the error E of this factorization: ε |v|ᵀ |L| |D| |L|ᵀ |v|. With v the
  /// eigenvector nearest zero: eigenvalues that are no greater may have either sign.
  virtual double roundoff(const Eigen::Ref<const Vector>& v) const = 0;

  /// Columns that the matrices to come hardly resist, as far as one knows; none at first. Where they are found makes
  /// large indefinite matrices quicker; results depend on them within round-off.
  virtual void expect_near_null(const Matrix&) {}

  /// Whether these may be of use for the pattern at hand.
  virtual bool may_use_near_null() const { return false; }
};

using MakeFactorization = std::function<std::unique_ptr<Factorization>()>;

/// The library's own (core/algebra/ldlt.hpp).
std::unique_ptr<Factorization> make_ldlt();

}  // namespace arcwall
