#include "core/algebra/solvers/simplicial_ldlt.hpp"

#include <cmath>
#include <vector>

#include "core/algebra/solvers/cholmod_factor.hpp"

namespace arcwall {

namespace {

class SimplicialLdlt final : public SymmetricFactors {
 public:
  SimplicialLdlt(const SparseMatrix& A, Index multipliers) : pattern_(A), multipliers_(multipliers) {
    ldlt_.common.supernodal = CHOLMOD_SIMPLICIAL;
    ldlt_.common.final_ll = 0;
    std::vector<Index> order = structure_order(A);
    insert_multipliers(A, order);
    cholmod_sparse a = cholmod_view(pattern_, A.valuePtr());
    ldlt_.common.method[0].ordering = CHOLMOD_GIVEN;
    ldlt_.common.postorder = 0;
    ldlt_.factor = cholmod_l_analyze_p(&a, as_long(order.data()), nullptr, 0, &ldlt_.common);
  }

  FactorStatus factorize(const SparseMatrix& A, const MatrixProperties& /*known*/) override {
    if (!is_finite(A)) return FactorStatus::not_finite;
    if (ldlt_.factor == nullptr) return FactorStatus::singular;
    cholmod_sparse a = cholmod_view(pattern_, A.valuePtr());
    cholmod_l_factorize(&a, ldlt_.factor, &ldlt_.common);
    return read_pivots() ? FactorStatus::ok : FactorStatus::singular;
  }

  void solve(Eigen::Ref<Matrix> X) const override { ldlt_.solve(X); }

  double weighted(const Eigen::Ref<const Vector>& v) const override {
    const cholmod_factor& L = *ldlt_.factor;
    const auto* start = static_cast<const SuiteSparse_long*>(L.p);
    const auto* count = static_cast<const SuiteSparse_long*>(L.nz);
    const auto* row = static_cast<const SuiteSparse_long*>(L.i);
    const auto* value = static_cast<const double*>(L.x);
    const Vector u = v(ldlt_.order()).cwiseAbs();
    double sum = 0.0;
    for (Index j = 0; j < v.size(); ++j) {
      double z = u[j];  // (|L|ᵀ |v|)_j
      for (Index k = start[j] + 1; k < start[j] + count[j]; ++k) z += std::abs(value[k]) * u[row[k]];
      sum += std::abs(value[start[j]]) * z * z;
    }
    return sum;
  }

 private:
  // Approximate minimum degree, postordered, of the leading block without multipliers.
  std::vector<Index> structure_order(const SparseMatrix& A) {
    const Index n = A.cols() - multipliers_;
    const SparseMatrix block = A.topLeftCorner(n, n);
    const Pattern pattern(block);
    cholmod_sparse b = cholmod_view(pattern, block.valuePtr());
    ldlt_.common.method[0].ordering = CHOLMOD_AMD;
    ldlt_.common.postorder = 1;
    cholmod_factor* symbolic = cholmod_l_analyze(&b, &ldlt_.common);
    const auto* perm = static_cast<const SuiteSparse_long*>(symbolic->Perm);
    std::vector<Index> order(perm, perm + n);
    cholmod_l_free_factor(&symbolic, &ldlt_.common);
    return order;
  }

  // Each multiplier right behind the last unknown that its row touches.
  void insert_multipliers(const SparseMatrix& A, std::vector<Index>& order) const {
    if (multipliers_ == 0) return;
    const Index n = A.cols() - multipliers_;
    std::vector<Index> last(static_cast<std::size_t>(multipliers_), -1);  // position of the last unknown touched
    for (Index position = 0; position < n; ++position)
      for (SparseMatrix::InnerIterator entry(A, order[static_cast<std::size_t>(position)]); entry; ++entry)
        if (entry.row() >= n) last[static_cast<std::size_t>(entry.row() - n)] = position;
    std::vector<std::vector<Index>> behind(static_cast<std::size_t>(n));
    std::vector<Index> merged;
    for (Index m = 0; m < multipliers_; ++m) {
      const Index position = last[static_cast<std::size_t>(m)];
      if (position < 0) merged.push_back(n + m);  // touches nothing: its zero pivot is found by the factorization
      if (position >= 0) behind[static_cast<std::size_t>(position)].push_back(n + m);
    }
    for (Index position = 0; position < n; ++position) {
      merged.push_back(order[static_cast<std::size_t>(position)]);
      const auto& next = behind[static_cast<std::size_t>(position)];
      merged.insert(merged.end(), next.begin(), next.end());
    }
    order = std::move(merged);
  }

  // Of zeros and of what is not finite CHOLMOD says nothing.
  bool read_pivots() {
    const cholmod_factor& L = *ldlt_.factor;
    if (ldlt_.common.status < CHOLMOD_OK || L.xtype != CHOLMOD_REAL || L.minor < L.n) return false;
    const auto* start = static_cast<const SuiteSparse_long*>(L.p);
    const auto* value = static_cast<const double*>(L.x);
    pivots_ = {};
    for (Index j = 0; j < ldlt_.size(); ++j)
      if (!pivots_.add(value[start[j]])) return false;
    return true;
  }

  CholmodFactor ldlt_;
  Pattern pattern_;
  Index multipliers_;
};

}  // namespace

std::unique_ptr<SymmetricFactors> simplicial_ldlt(const SparseMatrix& A, Index multipliers) {
  return std::make_unique<SimplicialLdlt>(A, multipliers);
}

}  // namespace arcwall
