#include "benchmarks/timed_solvers.hpp"

namespace arcwall::bench {

FactorStatus TimedFactorization::factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known) {
  const ScopedTimer timer(times_.factorization);
  ++times_.factorizations;
  return inner_->factorize(lower_triangle, known);
}

void TimedFactorization::solve(Eigen::Ref<Matrix> X) const {
  if (times_parts && system_.is_newton(X)) ++times_.iterations;
  const ScopedTimer timer(times_.solution);
  ++times_.solutions;
  times_.columns += X.cols();
  inner_->solve(X);
}

}  // namespace arcwall::bench
