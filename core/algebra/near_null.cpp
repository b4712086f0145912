#include "core/algebra/near_null.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/algebra/sliding_stability.hpp"
#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

namespace {

// The places of values by their magnitude, equal ones as they stand.
template <class Before>
std::vector<Index> by_magnitude(const Vector& values, const Before& before) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return before(std::abs(values[a]), std::abs(values[b])); });
  return order;
}

constexpr int max_rounds = 100;
constexpr Index most_followed = 2;  // that are followed

// The same start every time: numbers in (−½, ½) from a linear congruence (Knuth's MMIX constants), from a seed.
void fill_with_start(Eigen::Ref<Matrix> X, std::uint64_t seed) {
  for (Index j = 0; j < X.cols(); ++j)
    for (double *entry = &X(0, j), *end = entry + X.rows(); entry != end; ++entry) {
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
      *entry = double(seed >> 11) * 0x1p-53 - 0.5;
    }
}

// Columns of unit length, without dependent ones growing: QR with respect to the ordinary product.
Matrix orthonormal(const Matrix& X) {
  return Eigen::HouseholderQR<Matrix>(X).householderQ() * Matrix::Identity(X.rows(), X.cols());
}

// Below which Rayleigh quotients do not settle: the diagonal's part of the round-off of φᵀ K φ.
double roundoff_of_quotients(const SparseMatrix& K, const Matrix& X) {
  const Vector diagonal = K.diagonal().cwiseAbs();
  return std::numeric_limits<double>::epsilon() * (diagonal.transpose() * X.cwiseAbs2()).maxCoeff();
}

}  // namespace

Matrix NearNull::least_resisted() const {
  std::vector<Index> chosen;
  for (Index j = 0; j < values.size(); ++j)
    if (j == 0 || values[j] < 0.0) chosen.push_back(j);
  return (*vectors)(Eigen::all, chosen);
}

Index pair_count(const Vector& weights) {
  const Index weighted = (weights.array() > 0.0).count();
  return std::max<Index>(0, 2 * weighted - weights.size());
}

namespace {

// Inverse subspace iteration. `pairs`: how many there are.
template <class Operator>
NearNull nearest_zero(const Operator& K, const Vector& weights, Index pairs, Index count, Convergence convergence,
                      const Matrix& start) {
  count = std::min(count, pairs);
  const Index block = std::min(pairs, count + 3);  // guard vectors speed the last wanted pair up
  if (block == 0) return {};
  Matrix X(weights.size(), block);
  fill_with_start(X, 1);
  const Index known = std::min(start.cols(), block);
  if (known > 0) X.leftCols(known) = start.leftCols(known);
  Vector values = Vector::Constant(block, infinity);
  for (int round = 0; round < max_rounds; ++round) {
    for (auto column : X.colwise()) column.array() *= weights.array();
    K.solve(X);
    X = orthonormal(X);
    // Rayleigh-Ritz: the best eigenpairs in the span of X, on which M is positive definite: K⁻¹ M leaves no column of
    // multipliers alone.
    Matrix XKX(block, block), XMX(block, block);
    for (Index j = 0; j < block; ++j) {
      XKX.col(j).noalias() = X.transpose() * K.product(X.col(j));
      XMX.col(j).noalias() = X.transpose() * weights.cwiseProduct(X.col(j));
    }
    const SymmetricEigen ritz = symmetric_eigenpairs(XKX, XMX);
    if (!ritz.values.allFinite()) break;
    const std::vector<Index> order = by_magnitude(ritz.values, std::less<>{});
    X *= ritz.vectors(Eigen::all, order);
    const Vector previous = values;
    values = ritz.values(order);
    const double scale = values.head(count).cwiseAbs().maxCoeff();
    const double change = (values - previous).head(count).cwiseAbs().maxCoeff();
    if (convergence == Convergence::tight && change <= 1e-10 * scale) break;
    if (convergence == Convergence::loose &&
        change <= std::max(1e-6 * scale, roundoff_of_quotients(K.matrix(), X.leftCols(count))))
      break;
  }
  X.conservativeResize(X.rows(), count);
  return {.values = values.head(count), .vectors = std::move(X)};
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
                   Convergence convergence, const Matrix& start) {
  return nearest_zero(Factorized{factorization, K}, weights, pair_count(weights), count, convergence, start);
}

NearNull near_null(const SlidingStabilityOperator& border, const Vector& weights, Index count,
                   Convergence convergence) {
  const Index pairs = pair_count(weights) + static_cast<Index>(border.released().size());
  return nearest_zero(border, weights, pairs, count, convergence, {});
}

namespace {

// T with (X T)ᵀ W X T = 1 for G = Xᵀ W X, by Gram and Schmidt. Columns that depend on those before them become zero.
Matrix orthonormalising(const Matrix& G) {
  constexpr double dependent = 1e-14;
  Matrix T = Matrix::Identity(G.rows(), G.cols());
  for (Index j = 0; j < T.cols(); ++j) {
    for (Index i = 0; i < j; ++i) T.col(j) -= T.col(i).dot(G * T.col(j)) * T.col(i);
    const double squared = T.col(j).dot(G * T.col(j));
    T.col(j) *= squared > dependent * G(j, j) ? 1.0 / std::sqrt(squared) : 0.0;
  }
  return T;
}

}  // namespace

Matrix NearNullTracker::right_hand_sides(const Vector& weights, Index front) {
  const Index n = weights.size(), block = std::min<Index>(most_followed + 1, pair_count(weights));
  const Index known = std::max<Index>(0, std::min(pairs_->cols(), block - 1));
  // Contact forces, which come and go at the end, have no weight and need no start.
  const Index common = std::min(pairs_->rows(), n);
  X_.resize(n, block);
  if (block == 0) return Matrix(n, front);
  X_.topLeftCorner(common, known) = pairs_->topLeftCorner(common, known);
  X_.bottomLeftCorner(n - common, known).setZero();
  if (known < block) fill_with_start(X_.rightCols(block - known), 1);
  X_ *= orthonormalising(X_.transpose() * weights.asDiagonal() * X_);
  Matrix columns(n, front + block);
  columns.rightCols(block) = weights.asDiagonal() * X_;
  return columns;
}

// On the span of X, W-orthonormal, K⁻¹ is A = Xᵀ W K⁻¹ W X. Its greatest eigenvalues θ in magnitude belong to pairs
// near zero, and never to a mixture of far ones, as the least of Xᵀ K X may. y = K⁻¹ W X c has the Rayleigh quotient
// θ/(yᵀ W y).
NearNull NearNullTracker::advance(const Vector& weights, const Eigen::Ref<const Matrix>& solutions) {
  const Index block = X_.cols(), count = std::min(block, most_followed);
  if (block == 0 || !all_finite(solutions)) return {};
  for (auto column : X_.colwise()) column.array() *= weights.array();
  const Matrix A = X_.transpose() * solutions;
  const SymmetricEigen ritz = symmetric_eigenpairs(0.5 * (A + A.transpose()));
  std::vector<Index> order = by_magnitude(ritz.values, std::greater<>{});
  order.resize(static_cast<std::size_t>(count));
  Matrix pairs = solutions * ritz.vectors(Eigen::all, order);
  X_.resize(0, 0);
  Vector values(count);
  for (Index j = 0; j < count; ++j) {
    const double squared = (weights.array() * pairs.col(j).array().square()).sum();
    values[j] = ritz.values[order[static_cast<std::size_t>(j)]] / squared;
    pairs.col(j) /= std::sqrt(squared);
  }
  pairs_ = std::move(pairs);
  return {.values = std::move(values), .vectors = pairs_};
}

}  // namespace arcwall
