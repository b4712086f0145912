#pragma once

#include "core/algebra/factorization.hpp"
#include "core/eigenpairs.hpp"

namespace arcwall {

class SlidingStabilityOperator;

/// How many eigenvalues K φ = μ M φ has: each unknown without weight is a multiplier, which holds one that has weight.
Index pair_count(const Vector& weights);

/// The unknown in which a vector that a matrix hardly resists has most of its energy: where a spring holds it best.
/// `diagonal`: the matrix's.
inline Index near_null_place(const Vector& diagonal, const Vector& vector) {
  Index place = 0;
  vector.cwiseAbs2().cwiseProduct(diagonal.cwiseAbs()).maxCoeff(&place);
  return place;
}

/// When eigenvalues count as found: once they change by 1e-10 of the greatest that is wanted; or by 1e-6, or by no more
/// than round-off, which on very fine meshes is more.
enum class Convergence { tight, loose };

/// `count` eigenpairs (fewer if there are no more) by inverse subspace iteration with Rayleigh-Ritz
/// projection. The factorization is that of `lower_triangle`; a tiny shift of it will do, where the matrix itself is
/// singular. With multipliers of weight zero these are the eigenvalues of K on the space the constraints leave free.
/// `start`: columns that are near the vectors wanted, if such are known.
NearNull near_null(const Factorization& factorization, const SparseMatrix& lower_triangle, const Vector& weights,
                   Index count, Convergence convergence = Convergence::tight, const Matrix& start = {});

/// The same of K with what a border holds let go.
NearNull near_null(const SlidingStabilityOperator& border, const Vector& weights, Index count,
                   Convergence convergence = Convergence::tight);

/// The pairs nearest zero, followed from matrix to matrix by one step of inverse iteration each. Near singularity one
/// step is enough; elsewhere the values are upper bounds in magnitude that get better on the way. A vector without
/// symmetry is solved for along, so that no mode can come near unseen.
class NearNullTracker {
 public:
  /// Goes on from these vectors; their number of rows may be that of another active set.
  void start_from(const SharedMatrix& vectors) { pairs_ = vectors; }

  /// Those at hand, of any length: the pairs' after advance().
  const Matrix& vectors() const { return *pairs_; }

  /// Right-hand sides W X, whose solutions with K `advance` wants; few columns, none if W has no entry above zero.
  /// Before them `front` columns are left for others.
  Matrix right_hand_sides(const Vector& weights, Index front = 0);

  /// `solutions`: K⁻¹ W X. Gives the pairs, at most two.
  NearNull advance(const Vector& weights, const Eigen::Ref<const Matrix>& solutions);

 private:
  SharedMatrix pairs_;
  Matrix X_;  // between right_hand_sides() and advance() alone: W-orthonormal, the pairs' vectors and one more
};

}  // namespace arcwall
