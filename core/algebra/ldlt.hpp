#pragma once

#include <memory>
#include <vector>

#include "core/algebra/factorization.hpp"
#include "core/ground_term.hpp"

namespace arcwall {

/// LDLᵀ of a symmetric matrix given by its lower triangle, indefinite matrices included: BlockTridiagonalLdlt where the
/// pattern is such, CHOLMOD's supernodal LLᵀ with springs (modified_cholesky.hpp) for large structures of many
/// couplings, its simplicial LDLᵀ elsewhere and for what those refuse.
///
/// Saddle points [K −Gᵀ; −G 0] keep zeros on the diagonal: each multiplier is eliminated right after the last unknown
/// it touches, where its pivot −g S⁻¹ gᵀ is not zero, so that no pivoting is needed and no fill arises beyond that of
/// K.
class Ldlt final : public Factorization {
 public:
  Ldlt();
  ~Ldlt() override;
  Ldlt(Ldlt&&) noexcept;
  Ldlt& operator=(Ldlt&&) noexcept;

  /// The last `count` unknowns are multipliers; takes effect with the next new pattern.
  void set_multiplier_count(Index count);

  /// Unknowns of nodes on which no force arises where everything moves parallel (see Linearization); none by default.
  /// Takes effect with the next matrix whose pattern is not trusted.
  void set_translation_free(std::vector<bool> unknowns);

  /// Which parts of the entries of the matrices to come are ground terms; none by default. Must outlive these
  /// factorizations.
  void set_ground(GroundTerms ground);

  /// Columns that the matrices to come hardly resist, as far as one knows; none by default. Where they are found makes
  /// large indefinite matrices quicker; results depend on them within round-off.
  void expect_near_null(Matrix vectors);

  /// Whether these may be of use for the pattern at hand.
  bool may_use_near_null() const;

  /// Whether the matrices to come are known to have the pattern of the last one, so that it is not compared; false by
  /// default.
  void trust_pattern(bool same);

  FactorStatus factorize(const SparseMatrix& lower_triangle) override;
  void solve(Eigen::Ref<Matrix> X) const override;
  std::optional<Inertia> inertia() const override;

  /// Least |pivot| over greatest; small near singularity. 0 if not factorized.
  double pivot_ratio() const;

  /// Greatest |pivot| over the greatest entry of the matrix that was factorized: much above 1 where a part that was
  /// eliminated before the rest is nearly singular by itself, which costs as many digits.
  double growth(const SparseMatrix& lower_triangle) const;

  /// vᵀ E v at most, up to a small factor, of the error E of this factorization: ε |v|ᵀ |L| |D| |L|ᵀ |v|. With v the
  /// eigenvector nearest zero: eigenvalues that are no greater may have either sign.
  double roundoff(const Eigen::Ref<const Vector>& v) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace arcwall
