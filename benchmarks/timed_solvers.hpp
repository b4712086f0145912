#pragma once

#include <memory>

#include "benchmarks/timed_system.hpp"
#include "core/algebra/factorization.hpp"

namespace arcwall::bench {

/// What factorizations took, and Newton's iterations.
struct SolverTimes {
  double factorization = 0.0;  ///< [s]
  double solution = 0.0;       ///< [s]
  Index factorizations = 0, solutions = 0;
  Index columns = 0;     ///< right-hand sides
  Index iterations = 0;  ///< of the corrector, wherever it was used
};

/// The library's factorization, with the time that its functions take.
class TimedFactorization final : public Factorization {
 public:
  /// Of matrices of `system`. Both must outlive this.
  TimedFactorization(const TimedSystem& system, SolverTimes& times) : system_(system), times_(times) {}

  FactorStatus factorize(const SparseMatrix& lower_triangle, const MatrixProperties& known) override;
  void solve(Eigen::Ref<Matrix> X) const override;
  std::optional<Inertia> inertia() const override { return inner_->inertia(); }
  double pivot_ratio() const override { return inner_->pivot_ratio(); }
  double growth(const SparseMatrix& lower_triangle) const override { return inner_->growth(lower_triangle); }
  double roundoff(const Eigen::Ref<const Vector>& v) const override { return inner_->roundoff(v); }
  void expect_near_null(const Matrix& vectors) override { inner_->expect_near_null(vectors); }
  bool may_use_near_null() const override { return inner_->may_use_near_null(); }

 private:
  const TimedSystem& system_;
  SolverTimes& times_;
  std::unique_ptr<Factorization> inner_ = make_ldlt();
};

}  // namespace arcwall::bench
