#pragma once

#include <Eigen/Dense>
#include <optional>
#include <random>

#include "contact/sliding_contact.hpp"
#include "core/system.hpp"

namespace arcwall::test {

/// Both triangles of a matrix of which the lower one is given.
Matrix full(const SparseMatrix& lower_triangle);

/// The lower triangle as a compressed sparse matrix, entries below `drop` in magnitude left out.
SparseMatrix lower_triangle(const Matrix& A, double drop = 0.0);

/// Numbers of a fixed sequence in (−1, 1).
class Numbers {
 public:
  explicit Numbers(unsigned seed) : engine_(seed) {}
  double operator()() { return 2.0 * (double(engine_()) + 0.5) / 4294967296.0 - 1.0; }
  Vector vector(Index n) {
    Vector v(n);
    for (double& entry : v) entry = (*this)();
    return v;
  }
  Matrix matrix(Index rows, Index columns) {
    Matrix A(rows, columns);
    for (double& entry : A.reshaped()) entry = (*this)();
    return A;
  }

 private:
  std::mt19937 engine_;
};

/// Negative eigenvalues of K on {v : G v = 0}, from the dense matrix [K −Gᵀ; −G 0] of a state: K scaled to a unit
/// diagonal, a basis of the null space from a rank-revealing QR. Empty if an eigenvalue is too near zero to have a sure
/// sign.
std::optional<Index> dense_unstable_count(const System& system, const State& state);

/// The same with contact points that slide: those closed under a force above `tolerance` (in the scale of the guards)
/// hold the body, each with its spring on the tangency, or with the tangency held.
std::optional<Index> dense_unstable_count(const SlidingContact& system, const State& state, double tolerance);

/// F = 0 at the given λ by Newton's method with dense matrices, `steps` equal increments from the state's λ. Fails the
/// test if it does not converge.
State solved_at(const System& system, State from, double lambda, int steps);

/// Least-squares slope of log(error) against log(size).
double observed_order(const std::vector<double>& sizes, const std::vector<double>& errors);

}  // namespace arcwall::test
