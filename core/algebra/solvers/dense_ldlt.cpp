#include "core/algebra/solvers/dense_ldlt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

// LAPACK, which CHOLMOD brings with it.
extern "C" {
void dsytrf_(const char* triangle, const int* n, double* a, const int* lda, int* exchanges, double* work,
             const int* work_size, int* info);
void dsytrs_(const char* triangle, const int* n, const int* columns, const double* a, const int* lda,
             const int* exchanges, double* b, const int* ldb, int* info);
}

namespace arcwall {

namespace {

constexpr char lower = 'L';

}  // namespace

bool DenseLdlt::factorize(Matrix A) {
  pivots_ = {};
  factors_ = std::move(A);
  const auto n = static_cast<int>(factors_.cols());
  exchanges_.resize(static_cast<std::size_t>(n));
  const int ask = -1;
  int info = 0;
  double wanted = 0.0;
  dsytrf_(&lower, &n, factors_.data(), &n, exchanges_.data(), &wanted, &ask, &info);
  Vector work(std::max(1, static_cast<int>(wanted)));
  const auto work_size = static_cast<int>(work.size());
  dsytrf_(&lower, &n, factors_.data(), &n, exchanges_.data(), work.data(), &work_size, &info);
  return info == 0 && read_pivots();
}

void DenseLdlt::solve(Eigen::Ref<Matrix> X) const {
  const auto n = static_cast<int>(factors_.cols()), columns = static_cast<int>(X.cols()),
             stride = static_cast<int>(X.outerStride());
  int info = 0;
  dsytrs_(&lower, &n, &columns, factors_.data(), &n, exchanges_.data(), X.data(), &stride, &info);
}

bool DenseLdlt::read_pivots() {
  bool usable = true;
  for (Index j = 0; j < factors_.cols(); ++j) {
    if (exchanges_[static_cast<std::size_t>(j)] > 0) {
      usable = pivots_.add(factors_(j, j)) && usable;
    } else {
      const double a = factors_(j, j), b = factors_(j + 1, j), c = factors_(j + 1, j + 1);
      const double greater = 0.5 * (a + c) + std::copysign(std::hypot(0.5 * (a - c), b), a + c);
      usable = pivots_.add(greater) && usable;
      usable = pivots_.add((a * c - b * b) / greater) && usable;
      ++j;
    }
  }
  return usable;
}

}  // namespace arcwall
