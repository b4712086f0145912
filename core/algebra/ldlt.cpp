#include "core/algebra/ldlt.hpp"

#include <algorithm>
#include <cassert>

#include "core/algebra/block_tridiagonal/block_tridiagonal_ldlt.hpp"
#include "core/algebra/block_tridiagonal/null_space_ldlt.hpp"
#include "core/algebra/solvers/modified_cholesky.hpp"
#include "core/algebra/solvers/simplicial_ldlt.hpp"

namespace arcwall {

namespace {

// `couplings`: of the multipliers those, the first ones, that are taken into blocks.
std::unique_ptr<SymmetricFactors> analysed(const SparseMatrix& A, Index multipliers,
                                           const std::vector<bool>& translation_free, Index& couplings) {
  auto blocks = find_blocks(A, multipliers, BlockTridiagonalLdlt::widest);
  couplings = blocks ? take_in_couplings(A, multipliers, *blocks) : 0;
  const auto is_wide = [](const std::vector<Index>& block) {
    return static_cast<Index>(block.size()) > BlockTridiagonalLdlt::widest;
  };
  if (blocks && std::none_of(blocks->begin(), blocks->end(), is_wide)) {
    std::vector<bool> is_free = translation_free;
    if (!is_free.empty()) is_free.resize(is_free.size() + static_cast<std::size_t>(couplings), false);
    if (multipliers == couplings) return std::make_unique<BlockTridiagonalLdlt>(A, *blocks, is_free);
    if (auto pressed = NullSpaceLdlt::of(A, multipliers - couplings, *blocks, is_free)) return pressed;
  }
  std::unique_ptr<SymmetricFactors> large = multipliers > 0 ? nullptr : modified_cholesky(A);
  return large ? std::move(large) : simplicial_ldlt(A, multipliers);
}

std::vector<bool> without_multipliers(const MatrixProperties& known) {
  if (known.translation_free == nullptr) return {};
  const auto count = static_cast<std::ptrdiff_t>(known.translation_free->size());
  return {known.translation_free->begin(),
          known.translation_free->end() - std::min<std::ptrdiff_t>(known.multipliers, count)};
}

}  // namespace

std::unique_ptr<Factorization> make_ldlt() { return std::make_unique<Ldlt>(); }

void Ldlt::ensure_analysed(const SparseMatrix& A, const MatrixProperties& known) {
  const bool any = factors_ != nullptr && known.multipliers == multipliers_;
  if (any && known.same_pattern && pattern_.has_sizes_of(A)) return;
  std::vector<bool> translation_free = without_multipliers(known);
  const bool same = pattern_.is_of(A), same_structure = translation_free == translation_free_;
  if (any && same && same_structure) return;
  others_.reset();
  multipliers_ = known.multipliers;
  translation_free_ = std::move(translation_free);
  if (!factors_ || !same_structure || !factors_->reuse_analysis(A, multipliers_ - couplings_))
    factors_ = analysed(A, multipliers_, translation_free_, couplings_);
  factors_->expect_near_null(near_null_);
  if (!same) pattern_ = Pattern(A);
}

// Simplicial LDLᵀ serves all matrices.
FactorStatus Ldlt::factorize(const SparseMatrix& A, const MatrixProperties& known) {
  assert(A.isCompressed() && A.rows() == A.cols());
  usable_ = nullptr;
  ensure_analysed(A, known);
  SymmetricFactors* factors = factors_.get();
  FactorStatus status = factors->factorize(A, known);
  if (status == FactorStatus::singular && factors->refused()) {
    if (!others_) others_ = simplicial_ldlt(A, multipliers_);
    factors = others_.get();
    status = factors->factorize(A, known);
  }
  if (status == FactorStatus::ok) usable_ = factors;
  return status;
}

void Ldlt::solve(Eigen::Ref<Matrix> X) const {
  assert(usable_);
  usable_->solve(X);
}

std::optional<Inertia> Ldlt::inertia() const { return usable_ ? usable_->inertia() : std::nullopt; }

double Ldlt::pivot_ratio() const { return usable_ ? usable_->pivot_ratio() : 0.0; }

double Ldlt::growth(const SparseMatrix& A) const {
  assert(usable_);
  return usable_->growth(A);
}

double Ldlt::roundoff(const Eigen::Ref<const Vector>& v) const {
  assert(usable_);
  return usable_->roundoff(v);
}

void Ldlt::expect_near_null(const Matrix& vectors) {
  near_null_ = vectors;
  if (factors_) factors_->expect_near_null(near_null_);
}

bool Ldlt::may_use_near_null() const { return !factors_ || factors_->may_use_near_null(); }

}  // namespace arcwall
