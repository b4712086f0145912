#include "continuation/lambda_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/algebra/symmetric_eigen.hpp"

namespace arcwall {

namespace {

constexpr double stiffness_changes = 300.0;  // λ₀ over the λ at which the softest modes have lost their stiffness

// Of the structure by a first step: a load right above a contact goes into the obstacle, and round-off moves the rest.
constexpr double unmoved = 1e-13;

// Φᵀ K Φ, and how far round-off in the entries of K may move an entry of it.
struct ModalStiffness {
  Matrix values{};
  double roundoff = 0.0;
};

ModalStiffness modal_stiffness(TraceTools& tools, const State& state, const Matrix& modes) {
  Linearization& at = tools.workspace(state.active_set);
  tools.system.linearize(state, at);
  const auto form = [&](const Matrix& v) -> Matrix {
    return v.transpose() * (at.K.selfadjointView<Eigen::Lower>() * v);
  };
  ModalStiffness stiffness{.values = form(modes)};
  at.K.coeffs() = at.K.coeffs().abs();
  stiffness.roundoff = std::numeric_limits<double>::epsilon() * form(modes.cwiseAbs()).maxCoeff();
  return stiffness;
}

// Along the tangent t by which the structure moves by 1, with the eigenpairs (μ, Φ) of K nearest zero, it is the least
// |s| with
//
//     det(diag(μ) + s Φᵀ (∂K/∂s) Φ) = 0.
//
// Differences to both sides leave out what the membrane forces of the bent structure add: they are of second order.
double distance_to_buckling(TraceTools& tools, const State& start, const Direction& t, const NearNull& nearest) {
  constexpr double h = 1e-4;  // of the differences, by as much of which the structure moves
  const Matrix& modes = *nearest.vectors;
  if (nearest.values.size() == 0 || (nearest.values.array() <= 0.0).any()) return infinity;
  const ModalStiffness ahead = modal_stiffness(tools, moved(start, t, h), modes);
  const ModalStiffness behind = modal_stiffness(tools, moved(start, t, -h), modes);
  const Matrix change = ahead.values - behind.values;
  if (!(change.cwiseAbs().maxCoeff() > 4.0 * (ahead.roundoff + behind.roundoff))) return infinity;
  const Vector softness = nearest.values.cwiseSqrt().cwiseInverse();
  const Matrix relative = softness.asDiagonal() * change * softness.asDiagonal() / (2.0 * h);
  return 1.0 / symmetric_eigenvalues(relative).cwiseAbs().maxCoeff();
}

}  // namespace

std::optional<double> natural_lambda_scale(TraceTools& tools, const State& start) {
  const double first = std::abs(tools.options.step.first);
  const Metric metric = tools.metric_on(start.active_set, 1.0);
  const Direction up{.dx = Vector::Zero(start.x.size()), .dlambda = 1.0};
  const CorrectorResult at = tools.corrector.inspect(start, metric, up);
  tools.corrector.track_from({});
  if (!at.converged()) return std::nullopt;
  const double dlambda = at.tangent.dlambda;
  const double moves = std::sqrt(metric.inner_x(at.tangent, at.tangent) +
                                 dlambda * dlambda * tools.system.metric(start.active_set).squared_motion_by_lambda);
  const double rate = std::abs(dlambda) / moves;
  if (!(std::isfinite(rate) && rate > 0.0) || first <= unmoved * rate) return std::nullopt;
  const Direction t{.dx = at.tangent.dx / moves, .dlambda = dlambda / moves};
  return rate * std::min(1.0, stiffness_changes * distance_to_buckling(tools, start, t, at.nearest));
}

}  // namespace arcwall
