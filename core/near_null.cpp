#include "core/near_null.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace arcwall {

namespace {

constexpr int max_rounds = 100;

// The same start every time: numbers in (−½, ½) from a linear congruence (Knuth's MMIX constants).
Matrix start_block(Index rows, Index columns) {
  Matrix X(rows, columns);
  std::uint64_t seed = 1;
  for (double& entry : X.reshaped()) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    entry = double(seed >> 11) / 9007199254740992.0 - 0.5;
  }
  return X;
}

// Columns of unit length, without dependent ones growing: QR with respect to the ordinary product.
void orthonormalise(Matrix& X) {
  const Index rows = X.rows(), columns = X.cols();
  X = Eigen::HouseholderQR<Matrix>(X).householderQ() * Matrix::Identity(rows, columns);
}

}  // namespace

NearNull near_null(const Factorization& factorization, const SparseMatrix& K, const Vector& weights, Index count,
                   double relative_tolerance) {
  const Index n = K.rows(), free = (weights.array() > 0.0).count();
  count = std::min(count, free);
  const Index block = std::min(free, count + 3);  // guard vectors speed the last wanted pair up
  if (block == 0) return {};
  Matrix X = start_block(n, block);
  Vector values = Vector::Constant(block, infinity);
  for (int round = 0; round < max_rounds; ++round) {
    X = weights.asDiagonal() * X;
    factorization.solve(X);
    orthonormalise(X);
    // Rayleigh-Ritz: the best eigenpairs in the span of X, on which M is positive definite: K⁻¹ M leaves no column of
    // multipliers alone.
    const Matrix KX = K.selfadjointView<Eigen::Lower>() * X;
    const Matrix MX = weights.asDiagonal() * X;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ritz(X.transpose() * KX, X.transpose() * MX);
    if (ritz.info() != Eigen::Success || !ritz.eigenvalues().allFinite()) break;
    std::vector<Index> order(static_cast<std::size_t>(block));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::abs(ritz.eigenvalues()[a]) < std::abs(ritz.eigenvalues()[b]);
    });
    X = X * ritz.eigenvectors()(Eigen::all, order);
    const Vector previous = values;
    values = ritz.eigenvalues()(order);
    const double scale = values.head(count).cwiseAbs().maxCoeff();
    const double change = (values - previous).head(count).cwiseAbs().maxCoeff();
    if (change <= relative_tolerance * scale) break;
  }
  return {.values = values.head(count), .vectors = X.leftCols(count)};
}

}  // namespace arcwall
