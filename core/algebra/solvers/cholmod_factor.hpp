#pragma once

// CHOLMOD's factors and its views of our matrices, whose values are not copied. Not installed: whoever uses the
// libraries needs no header of CHOLMOD.
#include <cholmod.h>

#include "core/algebra/solvers/pattern.hpp"

namespace arcwall {

static_assert(sizeof(SuiteSparse_long) == sizeof(Index));

inline SuiteSparse_long* as_long(const Index* p) { return reinterpret_cast<SuiteSparse_long*>(const_cast<Index*>(p)); }

/// Of a lower triangle with this pattern.
inline cholmod_sparse cholmod_view(const Pattern& pattern, const double* values) {
  cholmod_sparse v{};
  v.nrow = v.ncol = pattern.columns.size() - 1;
  v.nzmax = pattern.rows.size();
  v.p = as_long(pattern.columns.data());
  v.i = as_long(pattern.rows.data());
  v.x = const_cast<double*>(values);
  v.stype = -1;
  v.itype = CHOLMOD_LONG;
  v.xtype = CHOLMOD_REAL;
  v.dtype = CHOLMOD_DOUBLE;
  v.sorted = 1;
  v.packed = 1;
  return v;
}

inline cholmod_dense cholmod_view(Eigen::Ref<Matrix> X) {
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

/// A factor with what CHOLMOD needs for it.
struct CholmodFactor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  CholmodFactor() {
    cholmod_l_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.try_catch = 1;
    common.nmethods = 1;
  }
  ~CholmodFactor() {
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  Index size() const { return static_cast<Index>(factor->n); }

  /// The order of elimination.
  Eigen::Map<const Eigen::Matrix<SuiteSparse_long, Eigen::Dynamic, 1>> order() const {
    return {static_cast<const SuiteSparse_long*>(factor->Perm), size()};
  }

  /// X := A⁻¹ X. What changes of `common` is its own workspace.
  void solve(Eigen::Ref<Matrix> X) const {
    if (X.cols() == 0) return;
    auto& workspace = const_cast<cholmod_common&>(common);
    cholmod_dense b = cholmod_view(X);
    cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, factor, &b, &workspace);
    X = Eigen::Map<const Matrix>(static_cast<const double*>(solution->x), X.rows(), X.cols());
    cholmod_l_free_dense(&solution, &workspace);
  }
};

}  // namespace arcwall
