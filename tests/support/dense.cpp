#include "tests/support/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

namespace {

// Negative eigenvalues of the symmetric K on {v : G v = 0}.
std::optional<Index> negative_on_null_space(const Matrix& stiffness, const Matrix& rows) {
  const Index n = stiffness.rows(), m = rows.rows();
  const Vector scale = stiffness.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  if (m >= n) return 0;
  Matrix K = scale.asDiagonal() * stiffness * scale.asDiagonal();
  if (m > 0) {
    Matrix G = rows * scale.asDiagonal();
    G.rowwise().normalize();
    const Eigen::ColPivHouseholderQR<Matrix> qr(G.transpose());
    EXPECT_EQ(qr.rank(), m) << "the gradients of the closed gaps depend on each other";
    K.applyOnTheLeft(qr.householderQ().adjoint());
    K.applyOnTheRight(qr.householderQ());
    K = K.bottomRightCorner(n - m, n - m).eval();
  }
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues();
  // Eigenvalues of a matrix with unit diagonal are sure to a few n ε.
  const double unsure = 32.0 * double(n) * std::numeric_limits<double>::epsilon();
  if ((values.array().abs() < unsure).any()) return std::nullopt;
  return (values.array() < 0.0).count();
}

}  // namespace

std::optional<Index> dense_unstable_count(const System& system, const State& state) {
  Linearization now;
  system.linearize(state, now);
  const Matrix whole = full(now.K);
  const Index m = system.multiplier_count(state.active_set), n = whole.rows() - m;
  return negative_on_null_space(whole.topLeftCorner(n, n), whole.bottomLeftCorner(m, n));
}

namespace {

// By which a point contact that slides resists a tilt, (8.8): c = p Λ_f/|κ − Λ_f κ_w|, with the curvatures along the
// body's travel and Λ_f = Λ − o κ the stretch of the face; infinite where the body lies on the wall.
double tilt_spring(const SlidingContact& system, const State& state, Index k) {
  const auto& on = static_cast<const SlidingContactLayout&>(*state.active_set.layout());
  const auto point = static_cast<std::size_t>(k);
  if (on.lies_beside(point)) return infinity;
  if (!state.active_set[point]) return 0.0;
  const auto [strand, position] = on.mesh().breakpoint(k);
  const MeshState now = mesh_state_of(state);
  const AxisPlace axis = on.mesh().node(strand, position, now);
  const AxisStrain strain = on.mesh().strain(k, SlidingMesh::At::before, now);
  const Vec2 face = system.contact(state, k).place;
  const Obstacle& wall = *system.obstacles()[on.points()[point].obstacle].surface;
  const double travel = std::cos(axis.angle) >= 0.0 ? 1.0 : -1.0;
  const double wall_curvature = travel * wall.curvature(face, state.lambda).value;
  const double offset = (face - axis.position).dot(Vec2(-std::sin(axis.angle), std::cos(axis.angle)));
  const double stretch = strain.stretch - offset * strain.curvature;
  const double bends = std::abs(strain.curvature - stretch * wall_curvature);
  return bends * system.scales().length > 1e-9 ? system.force(state, k) * stretch / bends : infinity;
}

}  // namespace

std::optional<Index> dense_unstable_count(const SlidingContact& system, const State& state, double tolerance) {
  Linearization now;
  system.linearize(state, now);
  const Matrix whole = full(now.K);
  const Index m = system.multiplier_count(state.active_set), n = whole.rows() - m;
  const Index points = mesh_of(state).breakpoints();
  Matrix K = whole.topLeftCorner(n, n);
  std::vector<Index> held;
  for (Index row = n; row < n + state.active_set.closed_count(); ++row)
    if (state.x[row] > tolerance * system.scales().force) held.push_back(row);
  for (Index row = n + state.active_set.closed_count(); row < whole.rows() - points; ++row) held.push_back(row);
  for (Index k = 0; k < points; ++k) {
    const Index row = whole.rows() - points + k;
    if (const double spring = tilt_spring(system, state, k); std::isfinite(spring)) {
      K += spring * whole.row(row).head(n).transpose() * whole.row(row).head(n);
    } else {
      held.push_back(row);
    }
  }
  return negative_on_null_space(K, whole(held, Eigen::seqN(0, n)));
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
