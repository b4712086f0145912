#pragma once

#include <optional>

#include "core/types.hpp"

namespace arcwall {

enum class FactorStatus { ok, singular, not_finite };

/// Signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  Index negative = 0;
  Index positive = 0;
};

/// A factorized sparse matrix. The symbolic analysis is kept while the pattern stays the same.
class Factorization {
 public:
  virtual ~Factorization() = default;

  /// Entries that are not finite are found before the library sees them. After any status but `ok` nothing may be
  /// solved.
  virtual FactorStatus factorize(const SparseMatrix& matrix) = 0;

  /// X := A⁻¹ X, for any number of columns.
  virtual void solve(Eigen::Ref<Matrix> X) const = 0;

  /// Empty for a factorization that does not show the signs.
  virtual std::optional<Inertia> inertia() const = 0;
};

}  // namespace arcwall
