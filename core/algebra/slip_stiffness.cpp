#include "core/algebra/slip_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "core/algebra/dense.hpp"
#include "core/algebra/sliding_stability.hpp"

namespace arcwall {

namespace {

constexpr double real = 1e-9;    // imaginary part over the greatest eigenvalue below which an eigenvalue is real
constexpr Index most_tried = 8;  // slips up to which all subsets are tried

double greatest(const Eigen::VectorXcd& values) { return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0; }

// Whether slips of these contacts alone start by themselves: D_AA has an eigenvalue −α < 0 whose eigenvector is ≥ 0,
// and the others stay at rest, D_CA y ≥ 0.
bool starts_with(const Matrix& D, const std::vector<Index>& moving, const std::vector<Index>& resting) {
  const Eigen::EigenSolver<Matrix> eigen(D(moving, moving));
  const auto values = eigen.eigenvalues();
  for (Index k = 0; k < values.size(); ++k) {
    if (values[k].real() >= 0.0 || std::abs(values[k].imag()) > real * greatest(values)) continue;
    Vector y = eigen.eigenvectors().col(k).real();
    if (y.sum() < 0.0) y = -y;
    if (y.minCoeff() < 0.0) continue;
    if (resting.empty() || (D(resting, moving) * y).minCoeff() >= 0.0) return true;
  }
  return false;
}

}  // namespace

// With R = C_x K⁻¹ B − C_s for the held places w: the laws of slip change by −R δw, and w = ± y. What else is in the
// border is eliminated; contacts that move along the body do so without slip.
Matrix slip_stiffness(const BorderedSolver& solver, const Linearization& equations) {
  std::vector<Index> slips, others;
  for (Index k = 0; k < equations.slip_senses.size(); ++k)
    (equations.slip_senses[k] != 0.0 ? slips : others).push_back(k);
  const Vector of_slips = equations.slip_senses(slips);
  const auto senses = of_slips.asDiagonal();
  if (others.empty()) return -(senses * solver.reduced() * senses);
  const Matrix R = reduced_rolling(solver, equations);
  const Eigen::PartialPivLU<Matrix> within(R(others, others));
  return -(senses * (R(slips, slips) - R(slips, others) * within.solve(Matrix(R(others, slips)))) * senses);
}

Index negative_real_eigenvalues(const Matrix& D) {
  if (D.cols() == 0 || !D.allFinite()) return 0;
  const Eigen::VectorXcd values = Eigen::EigenSolver<Matrix>(D, false).eigenvalues();
  const double zero = real * greatest(values);
  Index count = 0;
  for (Index k = 0; k < values.size(); ++k)
    count += values[k].real() < 0.0 && std::abs(values[k].imag()) <= zero ? 1 : 0;
  return count;
}

SlipStability slip_stability(const Matrix& D) {
  if (!D.allFinite()) return SlipStability::undecided;
  if (is_positive_definite(D)) return SlipStability::stable;
  if (D.cols() > most_tried) return SlipStability::undecided;
  for (unsigned subset = 1; subset < (1U << D.cols()); ++subset) {
    std::vector<Index> moving, resting;
    for (Index k = 0; k < D.cols(); ++k) (subset >> k & 1U ? moving : resting).push_back(k);
    if (starts_with(D, moving, resting)) return SlipStability::unstable;
  }
  return SlipStability::undecided;
}

}  // namespace arcwall
