#include "core/algebra/test_function.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/algebra/solvers/lu.hpp"
#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double clear = 4.0;      // times the round-off: what stands clear of it
constexpr double off = 1e-12;      // relative, of the vectors V
constexpr double nearby = 1000.0;  // times the round-off: what is looked at with Ψ
constexpr Index most_pairs = 16;   // that are looked for

SparseMatrix bordered(const SparseMatrix& K, const Matrix& B) {
  const Index n = K.cols(), k = B.cols();
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(static_cast<std::size_t>(2 * K.nonZeros() + 2 * n * k));
  for_each_of_both_triangles(K,
                             [&](Index row, Index column, double value) { entries.emplace_back(row, column, value); });
  for (Index j = 0; j < k; ++j)
    for (Index i = 0; i < n; ++i) {
      if (B(i, j) == 0.0) continue;
      entries.emplace_back(i, n + j, B(i, j));
      entries.emplace_back(n + j, i, B(i, j));
    }
  SparseMatrix whole(n + k, n + k);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

SparseMatrix shifted(const SparseMatrix& K, const Vector& weights, double shift) {
  SparseMatrix sum = K;
  for (Index i = 0; i < K.cols(); ++i)
    if (weights[i] > 0.0) sum.coeffRef(i, i) += shift * weights[i];
  sum.makeCompressed();
  return sum;
}

// The greatest entry as an eigenvalue of K φ = μ W φ.
double greatest_value(const SparseMatrix& K, const Vector& weights) {
  double greatest = 0.0;
  for (Index column = 0; column < K.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(K, column); entry; ++entry)
      if (weights[entry.row()] > 0.0) greatest = std::max(greatest, std::abs(entry.value()) / weights[entry.row()]);
  return greatest;
}

// Factorizes K, or K + shift W with the least shift that leaves no zero pivot.
bool factorize_nearly(const SparseMatrix& K, const Vector& weights, Index multipliers, Factorization& ldlt) {
  if (ldlt.factorize(K, {.multipliers = multipliers}) == FactorStatus::ok) return true;
  const double greatest = greatest_value(K, weights);
  if (greatest == 0.0) return false;
  for (const double part : {64.0 * epsilon, -96.0 * epsilon, 1e-8, -1.5e-8})
    if (ldlt.factorize(shifted(K, weights, part * greatest), {.multipliers = multipliers}) == FactorStatus::ok)
      return true;
  return false;
}

// The eigenpairs nearest zero, with the round-off of each.
struct Nearest {
  NearNull pairs;
  std::vector<double> roundoff;
  Index near = 0;  // of them so near that Ψ has to decide
};

enum class IfZero { go_on, give_up };  // within round-off: the pair nearest zero

// `ldlt`: of K or nearly; `start`: of the vectors.
std::optional<Nearest> nearest_pairs(const Factorization& ldlt, const SparseMatrix& K, const Vector& weights,
                                     Matrix start, IfZero if_zero) {
  for (Index wanted = 2; wanted <= most_pairs; wanted *= 2) {
    // Roughly will do: pairs that are near converge fast, and Ψ is exact.
    Nearest found{.pairs = near_null(ldlt, K, weights, wanted, Convergence::loose, start), .roundoff = {}};
    const Index count = found.pairs.values.size();
    if (!found.pairs.vectors->allFinite()) return std::nullopt;
    for (Index j = 0; j < count; ++j) {
      const auto v = found.pairs.vectors->col(j);
      const QuadraticForm form = quadratic_form(K, v);
      if (j == 0 && form.is_zero() && if_zero == IfZero::give_up) return std::nullopt;
      // The pair's own value has the round-off of the greatest entries of K, also where v is zero.
      found.pairs.values[j] = form.value / (weights.array() * v.array().square()).sum();
      found.roundoff.push_back(std::max(form.roundoff, ldlt.roundoff(v)));
      if (std::abs(found.pairs.values[j]) <= nearby * found.roundoff.back()) found.near = j + 1;
    }
    if (found.near < count || count < wanted) return found;
    start = *found.pairs.vectors;
  }
  return std::nullopt;  // round-off of K hides them all
}

// σ between the eigenvalues that are near and the next one.
double separating_shift(const Nearest& nearest) {
  const auto near = static_cast<std::size_t>(nearest.near);
  double inner = 0.0;
  for (std::size_t j = 0; j < near; ++j)
    inner = std::max({inner, std::abs(nearest.pairs.values[static_cast<Index>(j)]), nearest.roundoff[j]});
  const bool all = nearest.near == nearest.pairs.values.size();
  return all ? 10.0 * inner : std::sqrt(inner * std::abs(nearest.pairs.values[nearest.near]));
}

// Negative eigenvalues of K + shift W, if the shift keeps clear of round-off.
std::optional<Index> negative_at(const SparseMatrix& K, const Vector& weights, Index multipliers, double shift,
                                 const Nearest& nearest, Factorization& ldlt) {
  if (ldlt.factorize(shifted(K, weights, shift), {.multipliers = multipliers}) != FactorStatus::ok) return std::nullopt;
  for (Index j = 0; j < nearest.pairs.values.size(); ++j)
    if (std::abs(nearest.pairs.values[j] + shift) <= clear * ldlt.roundoff(nearest.pairs.vectors->col(j)))
      return std::nullopt;
  return ldlt.inertia()->negative;
}

// As many unknowns as there are vectors, held one by one where the vectors are large and differ most: a border of the
// vectors themselves would be dense, and LU with it takes a time like the square of the number of unknowns.
Matrix sparse_border(const Matrix& vectors, const Vector& weights) {
  const Matrix weighted = weights.cwiseSqrt().asDiagonal() * vectors;
  const Eigen::ColPivHouseholderQR<Matrix> by_size(weighted.transpose());
  Matrix border = Matrix::Zero(vectors.rows(), vectors.cols());
  for (Index j = 0; j < vectors.cols(); ++j) {
    const Index unknown = by_size.colsPermutation().indices()[j];
    border(unknown, j) = weights[unknown];
  }
  return border;
}

// The eigenvalues near zero are those of Vᵀ K V = −Ψ; rotated to its principal axes, each is a quadratic form whose
// round-off is known. V is off by round-off times the condition of the bordered matrix, and the form by its square.
std::optional<SignCount> signs_beside(const std::optional<Nearest>& nearest, const SparseMatrix& K,
                                      const Vector& weights, Index multipliers, const MakeFactorization& make) {
  if (!nearest) return std::nullopt;
  const Index n = K.cols();
  const double shift = separating_shift(*nearest);
  const auto ldlt = make();
  const auto below = negative_at(K, weights, multipliers, shift, *nearest, *ldlt);
  const auto above = negative_at(K, weights, multipliers, -shift, *nearest, *ldlt);
  if (!below || !above || *above - *below != nearest->near) return std::nullopt;

  SignCount count{.negative = *below, .positive = n - *above, .undecided = 0};
  if (nearest->near == 0) return count;
  const auto function =
      BorderedTestFunction::of(K, sparse_border(nearest->pairs.vectors->leftCols(nearest->near), weights));
  if (!function) return std::nullopt;
  const Matrix gram = function->vectors().transpose() * weights.asDiagonal() * function->vectors();
  const SymmetricEigen axes = symmetric_eigenpairs(-function->psi(), gram);
  if (!axes.values.allFinite()) return std::nullopt;
  const Matrix principal = function->vectors() * axes.vectors;
  const double of_vectors = off * off * greatest_value(K, weights);
  for (Index j = 0; j < nearest->near; ++j) {
    const QuadraticForm form = quadratic_form(K, principal.col(j));
    const bool zero = std::abs(form.value) <= std::max(form.roundoff, of_vectors);
    ++(zero ? count.undecided : form.value < 0.0 ? count.negative : count.positive);
  }
  return count;
}

}  // namespace

std::optional<BorderedTestFunction> BorderedTestFunction::of(const SparseMatrix& K, const Matrix& B) {
  const Index n = K.cols(), k = B.cols();
  Matrix right = Matrix::Zero(n + k, k);
  right.bottomRows(k).setIdentity();
  const auto X = solve_by_lu(bordered(K, B), right);
  if (!X) return std::nullopt;
  BorderedTestFunction function;
  function.vectors_ = X->topRows(n);
  const Matrix psi = X->bottomRows(k);
  function.psi_ = 0.5 * (psi + psi.transpose());
  return function;
}

std::optional<Index> negative_by_pivots(const Factorization& ldlt, const Vector& weights, const NearNull& nearest) {
  const auto inertia = ldlt.inertia();
  if (!inertia) return std::nullopt;
  if (pair_count(weights) == 0) return inertia->negative;
  if (nearest.values.size() == 0 || !all_finite(*nearest.vectors)) return std::nullopt;
  const bool decided = std::abs(nearest.values[0]) > clear * ldlt.roundoff(nearest.vectors->col(0));
  return decided ? std::optional(inertia->negative) : std::nullopt;
}

std::optional<SignCount> sign_count_near_singularity(const SparseMatrix& K, const Vector& weights, Index multipliers,
                                                     const MakeFactorization& make) {
  const auto ldlt = make();
  if (!factorize_nearly(K, weights, multipliers, *ldlt)) return std::nullopt;
  const auto nearest = nearest_pairs(*ldlt, K, weights, Matrix(K.cols(), 0), IfZero::go_on);
  return signs_beside(nearest, K, weights, multipliers, make);
}

std::optional<Index> negative_count(const Factorization& ldlt, const SparseMatrix& K, const Vector& weights,
                                    Index multipliers, const NearNull& nearest, const MakeFactorization& make) {
  if (const auto negative = negative_by_pivots(ldlt, weights, nearest)) return negative;
  const bool known = nearest.values.size() > 0 && nearest.vectors->allFinite();
  if (known && quadratic_form(K, nearest.vectors->col(0)).is_zero()) return std::nullopt;  // also to Ψ
  std::optional<SignCount> signs;
  if (known && ldlt.inertia())
    signs =
        signs_beside(nearest_pairs(ldlt, K, weights, *nearest.vectors, IfZero::give_up), K, weights, multipliers, make);
  else
    signs = sign_count_near_singularity(K, weights, multipliers, make);
  if (!signs || signs->undecided > 0) return std::nullopt;
  return signs->negative;
}

}  // namespace arcwall
