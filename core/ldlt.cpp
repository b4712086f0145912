#include "core/ldlt.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "core/chain_ldlt.hpp"

namespace arcwall {

static_assert(sizeof(SuiteSparse_long) == sizeof(Index));

namespace {

SuiteSparse_long* as_long(const Index* p) { return reinterpret_cast<SuiteSparse_long*>(const_cast<Index*>(p)); }

// CHOLMOD's view of the lower triangle: nothing is copied.
cholmod_sparse view(const SparseMatrix& A) {
  cholmod_sparse v{};
  v.nrow = static_cast<std::size_t>(A.rows());
  v.ncol = static_cast<std::size_t>(A.cols());
  v.nzmax = static_cast<std::size_t>(A.nonZeros());
  v.p = as_long(A.outerIndexPtr());
  v.i = as_long(A.innerIndexPtr());
  v.x = const_cast<double*>(A.valuePtr());
  v.stype = -1;
  v.itype = CHOLMOD_LONG;
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  v.sorted = 1;
  v.packed = 1;
  return v;
}

cholmod_dense view(Eigen::Ref<Matrix> X) {
  cholmod_dense v{};
  v.nrow = static_cast<std::size_t>(X.rows());
  v.ncol = static_cast<std::size_t>(X.cols());
  v.d = static_cast<std::size_t>(X.outerStride());
  v.nzmax = v.d * v.ncol;
  v.x = X.data();
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  return v;
}

}  // namespace

struct Ldlt::Implementation {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;  // workspaces of cholmod_solve2, kept from call to call
  cholmod_dense* workspace_y = nullptr;
  cholmod_dense* workspace_e = nullptr;
  std::optional<ChainLdlt> chain;    // of a pattern that is a chain; then CHOLMOD has nothing to do
  std::vector<Index> columns, rows;  // the pattern that was analysed
  Index multipliers = 0, analysed_multipliers = 0;
  bool usable = false;
  Inertia inertia{};
  double least_pivot = 0.0, greatest_pivot = 0.0;  // in magnitude

  Implementation() {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 0;
    common.print = 0;
    common.error_handler = nullptr;
    common.try_catch = 1;
  }

  ~Implementation() {
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&workspace_y, &common);
    cholmod_l_free_dense(&workspace_e, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }

  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  bool analysed(const SparseMatrix& A) const {
    const auto n = static_cast<std::size_t>(A.cols()) + 1, nonzeros = static_cast<std::size_t>(A.nonZeros());
    return (chain || factor != nullptr) && multipliers == analysed_multipliers && columns.size() == n &&
           rows.size() == nonzeros && std::memcmp(columns.data(), A.outerIndexPtr(), n * sizeof(Index)) == 0 &&
           std::memcmp(rows.data(), A.innerIndexPtr(), nonzeros * sizeof(Index)) == 0;
  }

  void analyse(const SparseMatrix& A) {
    cholmod_l_free_factor(&factor, &common);
    chain.reset();
    if (const auto groups = chain_groups(A, multipliers, ChainLdlt::widest))
      chain.emplace().analyse(A, *groups);
    else
      analyse_by_degree(A);
    columns.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    rows.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    analysed_multipliers = multipliers;
  }

  void analyse_by_degree(const SparseMatrix& A) {
    std::vector<Index> order = structure_order(A);
    insert_multipliers(A, order);
    cholmod_sparse a = view(A);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 0;
    factor = cholmod_l_analyze_p(&a, as_long(order.data()), nullptr, 0, &common);
  }

  // Approximate minimum degree, postordered, of the leading block without multipliers.
  std::vector<Index> structure_order(const SparseMatrix& A) {
    const Index n = A.cols() - multipliers;
    const SparseMatrix block = A.topLeftCorner(n, n);
    cholmod_sparse b = view(block);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
    cholmod_factor* symbolic = cholmod_l_analyze(&b, &common);
    const auto* perm = static_cast<const SuiteSparse_long*>(symbolic->Perm);
    std::vector<Index> order(perm, perm + n);
    cholmod_l_free_factor(&symbolic, &common);
    return order;
  }

  // Each multiplier right behind the last unknown that its row touches.
  void insert_multipliers(const SparseMatrix& A, std::vector<Index>& order) const {
    if (multipliers == 0) return;
    const Index n = A.cols() - multipliers;
    std::vector<Index> last(static_cast<std::size_t>(multipliers), -1);  // position of the last unknown touched
    for (Index position = 0; position < n; ++position)
      for (SparseMatrix::InnerIterator entry(A, order[static_cast<std::size_t>(position)]); entry; ++entry)
        if (entry.row() >= n) last[static_cast<std::size_t>(entry.row() - n)] = position;
    std::vector<std::vector<Index>> behind(static_cast<std::size_t>(n));
    std::vector<Index> merged;
    for (Index m = 0; m < multipliers; ++m) {
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

  double pivot(Index j) const {
    const auto* start = static_cast<const SuiteSparse_long*>(factor->p);
    return static_cast<const double*>(factor->x)[start[j]];
  }

  // Counts the signs. False when a pivot is zero or not finite, of which CHOLMOD says nothing.
  bool read_pivots() {
    if (common.status < CHOLMOD_OK || factor->xtype != CHOLMOD_REAL || factor->minor < factor->n) return false;
    inertia = {};
    least_pivot = infinity;
    greatest_pivot = 0.0;
    for (Index j = 0; j < static_cast<Index>(factor->n); ++j) {
      const double d = pivot(j), magnitude = std::abs(d);
      (d < 0.0 ? inertia.negative : inertia.positive) += 1;
      least_pivot = std::min(least_pivot, magnitude);
      greatest_pivot = std::max(greatest_pivot, magnitude);
      if (!(magnitude > 0.0 && magnitude < infinity)) return false;
    }
    return true;
  }
};

Ldlt::Ldlt() : implementation_(std::make_unique<Implementation>()) {}
Ldlt::~Ldlt() = default;
Ldlt::Ldlt(Ldlt&&) noexcept = default;
Ldlt& Ldlt::operator=(Ldlt&&) noexcept = default;

void Ldlt::set_multiplier_count(Index count) { implementation_->multipliers = count; }

FactorStatus Ldlt::factorize(const SparseMatrix& A) {
  Implementation& self = *implementation_;
  assert(A.isCompressed() && A.rows() == A.cols());
  self.usable = false;
  if (!Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).allFinite()) return FactorStatus::not_finite;
  if (!self.analysed(A)) self.analyse(A);
  if (self.chain) {
    self.usable = self.chain->factorize(A.valuePtr());
    return self.usable ? FactorStatus::ok : FactorStatus::singular;
  }
  if (self.factor == nullptr) return FactorStatus::singular;
  cholmod_sparse a = view(A);
  cholmod_l_factorize(&a, self.factor, &self.common);
  self.usable = self.read_pivots();
  return self.usable ? FactorStatus::ok : FactorStatus::singular;
}

void Ldlt::solve(Eigen::Ref<Matrix> X) const {
  Implementation& self = *implementation_;
  assert(self.usable);
  if (X.cols() == 0) return;
  if (self.chain) return self.chain->solve(X);
  cholmod_dense b = view(X);
  cholmod_l_solve2(CHOLMOD_A, self.factor, &b, nullptr, &self.solution, nullptr, &self.workspace_y, &self.workspace_e,
                   &self.common);
  X = Eigen::Map<const Matrix>(static_cast<const double*>(self.solution->x), X.rows(), X.cols());
}

std::optional<Inertia> Ldlt::inertia() const {
  const Implementation& self = *implementation_;
  if (!self.usable) return std::nullopt;
  return self.chain ? self.chain->inertia() : self.inertia;
}

double Ldlt::pivot_ratio() const {
  const Implementation& self = *implementation_;
  if (!self.usable) return 0.0;
  return self.chain ? self.chain->least_pivot() / self.chain->greatest_pivot() : self.least_pivot / self.greatest_pivot;
}

// Wilkinson: K + E = L D Lᵀ with |E| ≤ γ |L| |D| |L|ᵀ. Without pivoting L may grow; |K| alone would not show it.
double Ldlt::roundoff(const Vector& v) const {
  const Implementation& self = *implementation_;
  assert(self.usable);
  if (self.chain) return std::numeric_limits<double>::epsilon() * self.chain->weighted(v);
  const auto* start = static_cast<const SuiteSparse_long*>(self.factor->p);
  const auto* count = static_cast<const SuiteSparse_long*>(self.factor->nz);
  const auto* row = static_cast<const SuiteSparse_long*>(self.factor->i);
  const auto* value = static_cast<const double*>(self.factor->x);
  const Eigen::Map<const Eigen::Matrix<SuiteSparse_long, Eigen::Dynamic, 1>> order(
      static_cast<const SuiteSparse_long*>(self.factor->Perm), v.size());
  const Vector u = v(order).cwiseAbs();
  double sum = 0.0;
  for (Index j = 0; j < v.size(); ++j) {
    double z = u[j];  // (|L|ᵀ |v|)_j
    for (Index k = start[j] + 1; k < start[j] + count[j]; ++k) z += std::abs(value[k]) * u[row[k]];
    sum += std::abs(value[start[j]]) * z * z;
  }
  return std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace arcwall
