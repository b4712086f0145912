#include "core/algebra/ldlt.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/algebra/block_tridiagonal/block_tridiagonal_ldlt.hpp"
#include "core/algebra/block_tridiagonal/null_space_ldlt.hpp"
#include "core/algebra/solvers/modified_cholesky.hpp"
#include "core/algebra/solvers/pattern.hpp"
#include "core/algebra/solvers/simplicial_ldlt.hpp"

namespace arcwall {

struct Ldlt::Implementation {
  std::unique_ptr<SymmetricFactors> factors;  // of the pattern
  std::unique_ptr<SymmetricFactors> others;   // of the same, for what those refuse
  SymmetricFactors* usable = nullptr;         // which of them holds the last matrix
  Matrix soft;
  Pattern pattern;  // that was analysed
  Index multipliers = 0, analysed_multipliers = 0;
  std::vector<bool> translation_free, analysed_translations;
  GroundTerms ground;
  bool trusted = false;  // the pattern

  std::unique_ptr<SymmetricFactors> analyse(const SparseMatrix& A) const {
    if (auto blocks = find_blocks(A, multipliers, BlockTridiagonalLdlt::widest)) {
      if (multipliers == 0) return std::make_unique<BlockTridiagonalLdlt>(A, *blocks, translation_free);
      if (auto pressed = NullSpaceLdlt::of(A, multipliers, *blocks, translation_free)) return pressed;
    }
    std::unique_ptr<SymmetricFactors> large = multipliers > 0 ? nullptr : modified_cholesky(A);
    return large ? std::move(large) : simplicial_ldlt(A, multipliers);
  }

  void ensure_analysed(const SparseMatrix& A) {
    const bool any = factors != nullptr && multipliers == analysed_multipliers;
    if (any && trusted && pattern.has_sizes_of(A)) return;
    const bool same = pattern.is_of(A), same_structure = structure_translations() == analysed_translations;
    if (any && same && same_structure) return;
    others.reset();
    if (!factors || !same_structure || !factors->reuse_analysis(A, multipliers)) factors = analyse(A);
    factors->expect_near_null(soft);
    if (!same) pattern = Pattern(A);
    analysed_multipliers = multipliers;
    analysed_translations = structure_translations();
  }

  // Of the unknowns that are no multipliers: these come and go.
  std::vector<bool> structure_translations() const {
    const auto count = static_cast<std::ptrdiff_t>(translation_free.size());
    return {translation_free.begin(), translation_free.end() - std::min<std::ptrdiff_t>(multipliers, count)};
  }

  // Simplicial LDLᵀ serves all matrices.
  FactorStatus factorize(const SparseMatrix& A) {
    const auto is_finite = [&] { return all_finite(Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros())); };
    usable = nullptr;
    ensure_analysed(A);
    const bool asks = !factors->sees_what_is_not_finite();
    if (asks && !is_finite()) return FactorStatus::not_finite;
    if (factors->factorize(A, ground)) {
      usable = factors.get();
    } else if (factors->refused()) {
      if (!others) others = simplicial_ldlt(A, multipliers);
      if (others->factorize(A, ground)) usable = others.get();
    }
    if (usable != nullptr) return FactorStatus::ok;
    return asks || is_finite() ? FactorStatus::singular : FactorStatus::not_finite;
  }
};

Ldlt::Ldlt() : implementation_(std::make_unique<Implementation>()) {}
Ldlt::~Ldlt() = default;
Ldlt::Ldlt(Ldlt&&) noexcept = default;
Ldlt& Ldlt::operator=(Ldlt&&) noexcept = default;

void Ldlt::set_multiplier_count(Index count) { implementation_->multipliers = count; }

void Ldlt::set_translation_free(std::vector<bool> unknowns) { implementation_->translation_free = std::move(unknowns); }

void Ldlt::set_ground(GroundTerms ground) { implementation_->ground = ground; }

void Ldlt::expect_near_null(Matrix vectors) {
  Implementation& self = *implementation_;
  self.soft = std::move(vectors);
  if (self.factors) self.factors->expect_near_null(self.soft);
}

bool Ldlt::may_use_near_null() const {
  return !implementation_->factors || implementation_->factors->may_use_near_null();
}

void Ldlt::trust_pattern(bool same) { implementation_->trusted = same; }

FactorStatus Ldlt::factorize(const SparseMatrix& A) {
  assert(A.isCompressed() && A.rows() == A.cols());
  return implementation_->factorize(A);
}

void Ldlt::solve(Eigen::Ref<Matrix> X) const {
  assert(implementation_->usable);
  implementation_->usable->solve(X);
}

std::optional<Inertia> Ldlt::inertia() const {
  const SymmetricFactors* factors = implementation_->usable;
  return factors ? std::optional(factors->pivots().signs) : std::nullopt;
}

double Ldlt::pivot_ratio() const {
  const SymmetricFactors* factors = implementation_->usable;
  if (!factors) return 0.0;
  const Pivots pivots = factors->pivots();
  return pivots.least / pivots.greatest;
}

double Ldlt::growth(const SparseMatrix& A) const {
  assert(implementation_->usable);
  return implementation_->usable->growth(A);
}

// Wilkinson: K + E = L D Lᵀ with |E| ≤ γ |L| |D| |L|ᵀ. Without pivoting L may grow; |K| alone would not show it.
double Ldlt::roundoff(const Eigen::Ref<const Vector>& v) const {
  assert(implementation_->usable);
  return std::numeric_limits<double>::epsilon() * implementation_->usable->weighted(v);
}

}  // namespace arcwall
