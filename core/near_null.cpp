#include "core/near_null.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

// Below which Rayleigh quotients do not settle: the diagonal's part of the round-off of φᵀ K φ.
double roundoff_of_quotients(const SparseMatrix& K, const Matrix& X) {
  const Vector diagonal = K.diagonal().cwiseAbs();
  return std::numeric_limits<double>::epsilon() * (diagonal.transpose() * X.cwiseAbs2()).maxCoeff();
}

}  // namespace

Matrix NearNull::soft() const {
  std::vector<Index> chosen;
  for (Index j = 0; j < values.size(); ++j)
    if (j == 0 || values[j] < 0.0) chosen.push_back(j);
  return vectors(Eigen::all, chosen);
}

Index pair_count(const Vector& weights) {
  const Index weighted = (weights.array() > 0.0).count();
  return std::max<Index>(0, 2 * weighted - weights.size());
}

namespace {

// Inverse subspace iteration. `pairs`: how many there are.
template <class Operator>
NearNull nearest_zero(const Operator& K, const Vector& weights, Index pairs, Index count, Settled settled,
                      const Matrix& start) {
  count = std::min(count, pairs);
  const Index block = std::min(pairs, count + 3);  // guard vectors speed the last wanted pair up
  if (block == 0) return {};
  Matrix X = start_block(weights.size(), block);
  const Index known = std::min(start.cols(), block);
  if (known > 0) X.leftCols(known) = start.leftCols(known);
  Vector values = Vector::Constant(block, infinity);
  for (int round = 0; round < max_rounds; ++round) {
    X = weights.asDiagonal() * X;
    K.solve(X);
    orthonormalise(X);
    // Rayleigh-Ritz: the best eigenpairs in the span of X, on which M is positive definite: K⁻¹ M leaves no column of
    // multipliers alone.
    const Matrix KX = K.product(X);
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
    if (settled == Settled::fully && change <= 1e-10 * scale) break;
    if (settled == Settled::roughly &&
        change <= std::max(1e-6 * scale, roundoff_of_quotients(K.matrix(), X.leftCols(count))))
      break;
  }
  return {.values = values.head(count), .vectors = X.leftCols(count)};
}

// The matrix itself; a tiny shift of its factorization does not spoil the product.
struct Factorized {
  const Factorization& factorization;
  const SparseMatrix& K;

  void solve(Matrix& X) const { factorization.solve(X); }
  Matrix product(const Matrix& X) const { return K.selfadjointView<Eigen::Lower>() * X; }
  const SparseMatrix& matrix() const { return K; }
};

}  // namespace

NearNull near_null(const Factorization& factorization, const SparseMatrix& K, const Vector& weights, Index count,
                   Settled settled, const Matrix& start) {
  return nearest_zero(Factorized{factorization, K}, weights, pair_count(weights), count, settled, start);
}

NearNull near_null(const SprungBorder& border, const Vector& weights, Index count, Settled settled) {
  const Index pairs = pair_count(weights) + static_cast<Index>(border.released().size());
  return nearest_zero(border, weights, pairs, count, settled, {});
}

Matrix NearNullTracker::right_hand_sides(const Vector& weights, Index front) {
  const Index n = weights.size(), block = std::min<Index>(3, pair_count(weights));
  const Index kept = std::max<Index>(0, std::min(X_.cols(), block - 1));
  if (start_.rows() != n || start_.cols() != block) start_ = start_block(n, block);
  // Contact forces, which come and go at the end, have no weight and need no start.
  const Index common = std::min(X_.rows(), n);
  Matrix X(n, block);
  if (kept > 0) {
    X.topLeftCorner(common, kept) = X_.topLeftCorner(common, kept);
    X.bottomLeftCorner(n - common, kept).setZero();
  }
  X.rightCols(block - kept) = start_.rightCols(block - kept);
  Matrix columns(n, front + block);
  auto WX = columns.rightCols(block);
  for (Index j = 0; j < block; ++j) {
    for (Index i = 0; i < j; ++i) X.col(j) -= WX.col(i).dot(X.col(j)) * X.col(i);
    WX.col(j) = weights.cwiseProduct(X.col(j));
    const double norm = std::sqrt(WX.col(j).dot(X.col(j)));
    const double scale = norm > 0.0 ? 1.0 / norm : 0.0;
    X.col(j) *= scale;
    WX.col(j) *= scale;
  }
  X_ = std::move(X);
  return columns;
}

// On the span of X, W-orthonormal, K⁻¹ is A = Xᵀ W K⁻¹ W X. Its greatest eigenvalues θ in magnitude belong to pairs
// near zero, and never to a mixture of far ones, as the least of Xᵀ K X may. y = K⁻¹ W X c has the Rayleigh quotient
// θ/(yᵀ W y).
NearNull NearNullTracker::advance(const Vector& weights, const Eigen::Ref<const Matrix>& Y) {
  const Index block = X_.cols();
  if (block == 0 || !all_finite(Y)) return {};
  // A few columns: products of large blocks would only be prepared longer than they take.
  const Matrix A = X_.transpose().lazyProduct(weights.asDiagonal() * Y);
  const Eigen::SelfAdjointEigenSolver<Matrix> ritz(0.5 * (A + A.transpose()));
  std::vector<Index> order(static_cast<std::size_t>(block));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(ritz.eigenvalues()[a]) > std::abs(ritz.eigenvalues()[b]); });
  order.resize(static_cast<std::size_t>(std::min<Index>(2, block)));
  X_ = Y.lazyProduct(Matrix(ritz.eigenvectors()(Eigen::all, order)));
  NearNull pairs{.values = Vector(X_.cols()), .vectors = {}};
  for (Index j = 0; j < X_.cols(); ++j) {
    const double squared = (weights.array() * X_.col(j).array().square()).sum();
    pairs.values[j] = ritz.eigenvalues()[order[static_cast<std::size_t>(j)]] / squared;
    X_.col(j) /= std::sqrt(squared);
  }
  pairs.vectors = X_;
  return pairs;
}

}  // namespace arcwall
