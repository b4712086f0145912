#pragma once

#include <memory>
#include <vector>

#include "core/algebra/solvers/pattern.hpp"
#include "core/algebra/solvers/symmetric_factors.hpp"

namespace arcwall {

/// LDLᵀ by the way that suits the pattern: BlockTridiagonalLdlt where it is such, CHOLMOD's supernodal LLᵀ with springs
/// (modified_cholesky.hpp) for large structures of many couplings, its simplicial LDLᵀ elsewhere and for what those
/// refuse.
///
/// Saddle points [K −Gᵀ; −G 0] keep zeros on the diagonal: each multiplier is eliminated right after the last unknown
/// it touches, where its pivot −g S⁻¹ gᵀ is not zero, so that no pivoting is needed and no fill arises beyond that of
/// K.
class Ldlt final : public Factorization {
 public:
  FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known = {}) override;
  void solve(Eigen::Ref<Matrix> X) const override;
  std::optional<Inertia> inertia() const override;
  double pivot_ratio() const override;
  double growth(const SparseMatrix& lower_triangle) const override;
  double roundoff(const Eigen::Ref<const Vector>& v) const override;
  void expect_near_null(const Matrix& vectors) override;
  bool may_use_near_null() const override;

 private:
  void ensure_analysed(const SparseMatrix& A, const MatrixProperties& known);

  std::unique_ptr<SymmetricFactors> factors_;  // of the pattern
  std::unique_ptr<SymmetricFactors> others_;   // of the same, for what those refuse
  SymmetricFactors* usable_ = nullptr;         // which of them holds the last matrix
  Pattern pattern_;                            // that was analysed, with these
  Index multipliers_ = 0, couplings_ = 0;      // of these the first, which are eliminated with what they couple
  std::vector<bool> translation_free_;         // of the unknowns that are no multipliers: these come and go
  Matrix near_null_;
};

}  // namespace arcwall
