#include "continuation/events/interpolated_test_matrix.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

namespace {

constexpr std::size_t nodes = InterpolatedTestMatrix::nodes;

// Directions that Q of (1) makes of columns, with t_λ taken not negative.
Matrix without_fold(const Matrix& columns, const Metric& metric, const Direction& t) {
  const double along = std::abs(t.dlambda) / metric.lambda_scale();
  return columns - t.dx * (metric.weights().cwiseProduct(t.dx).transpose() * columns) / (1.0 + along);
}

// Cᵀ W K⁻¹ W C, C = Q B, of columns B at the sample reached last: on critical modes the inverse of S of (1).
std::optional<Matrix> flexibility(const SegmentSamples& on, const PathSample& sample, const Matrix& B) {
  const Matrix C = on.metric.weights().asDiagonal() * without_fold(B, on.metric, sample.tangent);
  const auto moved = on.corrector.responses(C);
  if (!moved) return std::nullopt;
  const Matrix product = C.transpose() * *moved;
  return Matrix(0.5 * (product + product.transpose()));
}

constexpr double critical_within = 50.0;  // times the least eigenvalue: those of critical modes

// The modes at the sample reached last whose eigenvalues, with Q of (1), are near zero.
Matrix critical_modes(const SegmentSamples& on, const PathSample& sample) {
  // (1) holds for any modes near these.
  const auto pairs = on.corrector.near_null(sample.state, on.metric.weights(), on.pairs, Convergence::loose);
  if (!pairs || pairs->vectors->cols() == 0 || !pairs->vectors->allFinite()) return {};
  const auto inverse = flexibility(on, sample, *pairs->vectors);
  if (!inverse) return {};
  const SymmetricEigen axes = symmetric_eigenpairs(*inverse);
  const Vector size = axes.values.cwiseAbs();
  std::vector<Index> critical;
  for (Index j = 0; j < size.size(); ++j)
    if (critical_within * size[j] >= size.maxCoeff()) critical.push_back(j);
  return *pairs->vectors * axes.vectors(Eigen::all, critical);
}

// The eigenvalue of this order, counted from the least of all, of which so many are negative; `near`: those nearest
// zero, by their magnitude. Of order 0: the greatest negative one. So one of several that come to zero nearly together
// is not taken for another. Empty where it is not near.
std::optional<double> eigenvalue_of_order(const Vector& near, Index negative, Index order) {
  const bool below = negative >= order;
  Index skipped = !below ? order - negative - 1 : order > 0 ? negative - order : 0;
  for (const double value : near)
    if ((value < 0.0) == below && skipped-- == 0) return value;
  return std::nullopt;
}

// S of (2) at the sample reached last; `modes` are set if they are empty.
std::optional<Matrix> matrix_of_pairs(const SegmentSamples& on, const PathSample& sample, Matrix& modes) {
  const auto pairs = on.corrector.near_null(sample.state, on.metric.weights(), on.pairs);
  if (!pairs || pairs->vectors->cols() == 0 || !pairs->vectors->allFinite()) return std::nullopt;
  const Vector size = pairs->values.cwiseAbs();
  const Index critical = (size.array() <= critical_within * size.minCoeff()).count();
  if (modes.cols() == 0) modes = pairs->vectors->leftCols(critical);
  const Matrix parts = modes.transpose() * on.metric.weights().head(modes.rows()).asDiagonal() * *pairs->vectors;
  const Matrix inverse = parts * pairs->values.cwiseInverse().asDiagonal() * parts.transpose();
  return Matrix(inverse.inverse());
}

// S of (1) or (2) at the sample reached last; `modes` are set if they are empty.
std::optional<Matrix> test_matrix(const SegmentSamples& on, const PathSample& sample, Vanishing what, Index order,
                                  Matrix& modes) {
  if (what == Vanishing::turning) return Matrix::Constant(1, 1, sample.tangent.dlambda / on.metric.lambda_scale());
  const bool has_border = !on.corrector.factorized().equations().is_symmetric();
  if (has_border && on.changes == 1) {
    const auto eigen = on.corrector.near_null(sample.state, on.metric.weights(), on.pairs);
    const auto value =
        eigen && sample.negative ? eigenvalue_of_order(eigen->values, *sample.negative, order) : std::nullopt;
    return value ? std::optional(Matrix(Matrix::Constant(1, 1, *value))) : std::nullopt;
  }
  if (has_border || on.turns) return matrix_of_pairs(on, sample, modes);
  if (modes.cols() == 0) modes = critical_modes(on, sample);
  if (modes.cols() == 0) return std::nullopt;
  const auto inverse = flexibility(on, sample, modes);
  if (!inverse) return std::nullopt;
  return Matrix(inverse->inverse());
}

}  // namespace

// The path across the chord at t. A point far from the interpolated one lies on another branch.
std::optional<PathSample> sample_at(SegmentSamples& on, double t) {
  const double L = on.segment.length();
  const ChordPlaneConstraint plane(on.metric, on.segment.from().state, on.segment.to().state, t);
  const State guess = on.segment.at(t);
  const Direction& forward = on.segment.from().tangent;
  CorrectorResult at = on.corrector.correct(guess, plane, on.metric, forward, 1e-2 * L);
  if (!at.converged() || on.metric.distance(at.state, guess) > 0.05 * L) return std::nullopt;
  if (!at.negative) at.negative = on.corrector.count_here(at.state, at.nearest);
  if (on.metric.inner(at.tangent, forward) < 0.0) at.tangent = reversed(std::move(at.tangent));
  PathSample sample{.t = t,
                    .state = std::move(at.state),
                    .tangent = std::move(at.tangent),
                    .iterations = at.iterations,
                    .residual = at.residual,
                    .negative = at.negative};
  on.seen.push_back(sample);
  return sample;
}

Vector InterpolatedTestMatrix::eigenvalues(double t) const {
  const auto weight = weights(t);
  Matrix S = weight[0] * values_[0];
  for (std::size_t i = 1; i < nodes; ++i) S += weight[i] * values_[i];
  return symmetric_eigenvalues(S);
}

double InterpolatedTestMatrix::rate(double t, Index j) const {
  const double h = 0.1 * spread_;
  return std::abs(eigenvalues(t + h)[j] - eigenvalues(t - h)[j]) / (2.0 * h);
}

PathPoint InterpolatedTestMatrix::point(double t, const Metric& metric) const {
  const auto weight = weights(t);
  PathPoint point;
  point.state = samples_[0].state;
  point.tangent = samples_[0].tangent;
  point.state.x *= weight[0];
  point.state.lambda *= weight[0];
  point.tangent.dx *= weight[0];
  point.tangent.dlambda *= weight[0];
  for (std::size_t i = 1; i < nodes; ++i) {
    point.state.x += weight[i] * samples_[i].state.x;
    point.state.lambda += weight[i] * samples_[i].state.lambda;
    point.tangent.dx += weight[i] * samples_[i].tangent.dx;
    point.tangent.dlambda += weight[i] * samples_[i].tangent.dlambda;
  }
  for (const PathSample& sample : samples_) point.iterations = std::max(point.iterations, sample.iterations);
  point.tangent = unit(metric, std::move(point.tangent));
  return point;
}

// Values of Lagrange's polynomials on the nodes.
std::array<double, InterpolatedTestMatrix::nodes> InterpolatedTestMatrix::weights(double t) const {
  std::array<double, nodes> value;
  for (std::size_t i = 0; i < nodes; ++i) {
    value[i] = 1.0;
    for (std::size_t j = 0; j < nodes; ++j)
      if (j != i) value[i] *= (t - samples_[j].t) / (samples_[i].t - samples_[j].t);
  }
  return value;
}

std::optional<InterpolatedTestMatrix> test_matrix_around(SegmentSamples& on, double centre, double spread,
                                                         Vanishing what, Index order) {
  constexpr double margin = 2e-3;  // the ends may be singular
  const double half = 1.5 * spread + margin, middle = std::clamp(centre, half, 1.0 - half);
  const std::array<double, nodes> offsets{-1.5, -0.5, 0.5, 1.5};
  const std::array<std::size_t, nodes> inner_first{1, 2, 0, 3};  // the modes are those of the first
  std::vector<PathSample> samples(nodes);
  std::array<Matrix, nodes> values;
  Matrix modes;
  for (const std::size_t i : inner_first) {
    auto sample = sample_at(on, middle + spread * offsets[i]);
    if (!sample) return std::nullopt;
    samples[i] = std::move(*sample);
    const auto value = test_matrix(on, samples[i], what, order, modes);
    if (!value || !value->allFinite()) return std::nullopt;
    values[i] = *value;
  }
  return InterpolatedTestMatrix(middle, spread, std::move(samples), std::move(values));
}

}  // namespace arcwall
