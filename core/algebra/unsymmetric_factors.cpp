#include "core/algebra/unsymmetric_factors.hpp"

#include <vector>

#include "core/algebra/solvers/lu.hpp"

namespace arcwall {

namespace {

// With an entry wherever K or its transpose has one, so that the pattern does not depend on what slips.
SparseMatrix sum_of(const SparseMatrix& K, const SparseMatrix& N) {
  std::vector<Eigen::Triplet<double, SparseIndex>> entries;
  entries.reserve(static_cast<std::size_t>(2 * K.nonZeros() + N.nonZeros()));
  const auto add = [&](Index row, Index column, double value) {
    entries.emplace_back(static_cast<SparseIndex>(row), static_cast<SparseIndex>(column), value);
  };
  for_each_of_both_triangles(K, add);
  for (Index k = 0; k < N.outerSize(); ++k)
    for (SparseMatrix::InnerIterator entry(N, k); entry; ++entry) add(entry.row(), entry.col(), entry.value());
  SparseMatrix sum(K.rows(), K.cols());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

}  // namespace

bool UnsymmetricFactors::factorize(const SparseMatrix& K, const SparseMatrix& N, bool same_pattern) {
  const SparseMatrix sum = sum_of(K, N);
  if (!all_finite(sum.coeffs())) return false;
  if (!lu_ || !same_pattern) {
    lu_ = std::make_unique<Lu>();
    lu_->analyzePattern(sum);
  }
  lu_->factorize(sum);
  if (lu_->info() == Eigen::Success) return true;
  lu_.reset();
  return false;
}

}  // namespace arcwall
