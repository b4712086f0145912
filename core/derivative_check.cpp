#include "core/derivative_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/bordered_solver.hpp"

namespace arcwall {

namespace {

double relative(double difference, double scale) { return difference / std::max(scale, 1e-300); }

// Central difference of `value(state)` in unknown i (i = size: in λ), of fourth order.
template <typename Function>
auto central_difference(const Function& value, State state, Index i, double step) {
  using Value = decltype(value(state));
  double& unknown = i < state.x.size() ? state.x[i] : state.lambda;
  const double at = unknown, h = step * (1.0 + std::abs(at));
  const auto difference = [&](double d) {
    unknown = at + d;
    const Value above = value(state);
    unknown = at - d;
    return Value(above - value(state));
  };
  const Value near = difference(h), far = difference(2.0 * h);
  return Value((8.0 * near - far) / (12.0 * h));
}

}  // namespace

double DerivativeReport::worst() const { return std::max({K, F_lambda, consistency, energy, guard_gradient}); }

DerivativeReport check_derivatives(const UnilateralSystem& system, const State& state, double step) {
  Linearization now;
  system.linearize(state, now);
  const auto residual = [&](const State& s) {
    Vector F(system.size(s.active_set));
    system.residual(s, F);
    return F;
  };
  const auto energy = [&](const State& s) { return system.energy(s); };
  const auto guards = [&](const State& s) { return system.guards(s); };
  const Index n = state.x.size();
  const Matrix K = product(now, Matrix::Identity(n, n));
  const double K_scale = K.cwiseAbs().maxCoeff();

  DerivativeReport report;
  const Vector F = residual(state);
  report.consistency = relative((F - now.F).norm(), F.norm() + K_scale * 1e-12);
  Matrix guard_rows(system.guard_count(state.active_set), n + 1);
  for (Index j = 0; j < system.guard_count(state.active_set); ++j) {
    const Row row = system.guard_gradient(state, j);
    guard_rows.row(j).head(n) = row.dx.transpose();
    guard_rows(j, n) = row.dlambda;
  }
  for (Index i = 0; i <= n; ++i) {
    const Vector column = central_difference(residual, state, i, step);
    if (i < n) report.K = std::max(report.K, relative((column - K.col(i)).cwiseAbs().maxCoeff(), K_scale));
    if (i == n) report.F_lambda = relative((column - now.F_lambda).norm(), now.F_lambda.norm());
    if (i < n && system.multiplier_count(state.active_set) == 0) {
      const double slope = central_difference(energy, state, i, step);
      report.energy = std::max(report.energy, relative(std::abs(slope - F[i]), F.norm() + K_scale * step));
    }
    if (system.guard_count(state.active_set) == 0) continue;
    const Vector slopes = central_difference(guards, state, i, step);
    for (Index j = 0; j < slopes.size(); ++j)
      report.guard_gradient = std::max(report.guard_gradient, relative(std::abs(slopes[j] - guard_rows(j, i)),
                                                                       guard_rows.row(j).cwiseAbs().maxCoeff()));
  }
  return report;
}

double check_gradient(const Observable& observable, const State& state, double step) {
  const Row row = observable.gradient(state);
  const auto value = [&](const State& s) { return observable.value(s); };
  double difference = 0.0, scale = std::abs(row.dlambda);
  for (Index i = 0; i <= state.x.size(); ++i) {
    const double analytic = i < state.x.size() ? row.dx[i] : row.dlambda;
    difference = std::max(difference, std::abs(central_difference(value, state, i, step) - analytic));
    scale = std::max(scale, std::abs(analytic));
  }
  const Direction along{.dx = Vector::LinSpaced(state.x.size(), -1.0, 1.0), .dlambda = 1.0};
  const double parts = row.dx.cwiseAbs().dot(along.dx.cwiseAbs()) + std::abs(row.dlambda);
  return std::max(relative(difference, scale),
                  relative(std::abs(observable.rate(state, along) - apply(row, along)), parts));
}

}  // namespace arcwall
