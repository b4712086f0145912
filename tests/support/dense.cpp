#include "tests/support/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace arcwall::test {

Matrix full(const SparseMatrix& lower) {
  const SparseMatrix both = lower.selfadjointView<Eigen::Lower>();
  return Matrix(both);
}

SparseMatrix lower_triangle(const Matrix& A, double drop) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = j; i < A.rows(); ++i)
      if (i == j || !(std::abs(A(i, j)) <= drop)) entries.emplace_back(i, j, A(i, j));
  SparseMatrix sparse(A.rows(), A.cols());
  sparse.setFromTriplets(entries.begin(), entries.end());
  sparse.makeCompressed();
  return sparse;
}

std::optional<Index> dense_unstable_count(const System& system, const State& state) {
  Linearization now;
  system.linearize(state, now);
  const Matrix whole = full(now.K);
  const Index m = system.multiplier_count(state.piece), n = whole.rows() - m;
  const Vector scale = whole.diagonal().head(n).cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  if (m >= n) return 0;
  Matrix K = scale.asDiagonal() * whole.topLeftCorner(n, n) * scale.asDiagonal();
  if (m > 0) {
    Matrix G = whole.bottomLeftCorner(m, n) * scale.asDiagonal();
    G.rowwise().normalize();
    const Eigen::ColPivHouseholderQR<Matrix> qr(G.transpose());
    EXPECT_EQ(qr.rank(), m) << "the gradients of the closed gaps depend on each other";
    const Matrix Q = qr.householderQ();
    const Matrix Z = Q.rightCols(n - m);
    K = (Z.transpose() * K * Z).eval();
  }
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues();
  // Eigenvalues of a matrix with unit diagonal are sure to a few n ε.
  const double unsure = 32.0 * double(n) * std::numeric_limits<double>::epsilon();
  if ((values.array().abs() < unsure).any()) return std::nullopt;
  return (values.array() < 0.0).count();
}

State solved_at(const System& system, State state, double lambda, int steps) {
  const double from = state.lambda;
  Linearization now;
  for (int step = 1; step <= steps; ++step) {
    state.lambda = from + (lambda - from) * step / steps;
    double previous = infinity;
    for (int iteration = 0; iteration < 50; ++iteration) {
      system.linearize(state, now);
      const Vector correction = Eigen::PartialPivLU<Matrix>(full(now.K)).solve(now.F);
      state.x -= correction;
      const double size = correction.norm() / (1e-3 + state.x.norm());
      if (!std::isfinite(size) || iteration == 49) {
        ADD_FAILURE() << "Newton does not converge at lambda = " << state.lambda;
        return state;
      }
      // Quadratic convergence has reached round-off when corrections no longer shrink.
      if (size < 1e-9 && size > 0.1 * previous) break;
      if (size < 1e-14) break;
      previous = size;
    }
  }
  return state;
}

double observed_order(const std::vector<double>& sizes, const std::vector<double>& errors) {
  const auto n = static_cast<Index>(sizes.size());
  const Vector x = Eigen::Map<const Vector>(sizes.data(), n).array().log();
  const Vector y = Eigen::Map<const Vector>(errors.data(), n).array().abs().log();
  const Vector dx = x.array() - x.mean();
  return dx.dot(y) / dx.squaredNorm();
}

}  // namespace arcwall::test
