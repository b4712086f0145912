#include "core/algebra/unsymmetric_stability.hpp"

#include <Eigen/Eigenvalues>

namespace arcwall {

namespace {

// The lower triangle of K + (N + Nᵀ)/2.
SparseMatrix symmetric_part(const Linearization& equations) {
  const SparseMatrix mirrored = equations.N.transpose();
  const SparseMatrix mean = 0.5 * (equations.N + mirrored);
  SparseMatrix part = equations.K + SparseMatrix(mean.triangularView<Eigen::Lower>());
  part.makeCompressed();
  return part;
}

std::optional<Inertia> inertia_of(const BorderedSolver& solver, const SparseMatrix& lower_triangle) {
  const auto factors = solver.make()();
  return factors->factorize(lower_triangle, {}) == FactorStatus::ok ? factors->inertia() : std::nullopt;
}

constexpr Index most_unknowns = 2000;  // whose eigenvalues are all computed: some ten seconds

std::optional<Index> by_all_eigenvalues(const Linearization& equations) {
  if (equations.K.cols() > most_unknowns) return std::nullopt;
  const Matrix lower = Matrix(equations.K);
  Matrix J = Matrix(lower.selfadjointView<Eigen::Lower>()) + Matrix(equations.N);
  const Vector scale = J.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return std::nullopt;
  J = (scale.asDiagonal() * J * scale.asDiagonal()).eval();
  const Eigen::EigenSolver<Matrix> eigen(J, false);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  return (eigen.eigenvalues().real().array() < 0.0).count();
}

}  // namespace

// None where the symmetric part is positive definite.
std::optional<Index> negative_real_parts(const BorderedSolver& solver, const Linearization& equations) {
  if (!solver.inner_is_regular()) return std::nullopt;
  const auto symmetric = inertia_of(solver, symmetric_part(equations));
  return symmetric && symmetric->negative == 0 ? std::optional<Index>(0) : by_all_eigenvalues(equations);
}

bool work_is_positive(const BorderedSolver& solver, const Linearization& equations) {
  SparseMatrix least = symmetric_part(equations) - equations.work_lost;
  least.makeCompressed();
  const auto inertia = inertia_of(solver, least);
  return inertia && inertia->negative == 0;
}

}  // namespace arcwall
