#pragma once

#include <algorithm>
#include <cmath>

#include "core/linearization.hpp"

namespace arcwall {

/// Defines the path metric of (x, λ), dimensionless and independent of the number of elements:
///
///     ⟨a, b⟩ = Σ w_i a_i b_i + a_λ b_λ / λ₀²
///
/// Multipliers have weight 0. λ₀ is constant in a run. Theory section 3.
class Metric {
 public:
  Metric(Vector weights, double lambda_scale) : weights_(std::move(weights)), lambda_scale_(lambda_scale) {}

  double inner_x(const Eigen::Ref<const Vector>& a, const Eigen::Ref<const Vector>& b) const {
    return (weights_.array() * a.array() * b.array()).sum();
  }
  double inner_x(const Direction& a, const Direction& b) const { return inner_x(a.dx, b.dx); }
  double inner_lambda(double a, double b) const { return a * b / (lambda_scale_ * lambda_scale_); }
  double inner(const Direction& a, const Direction& b) const {
    return inner_x(a, b) + inner_lambda(a.dlambda, b.dlambda);
  }
  double norm(const Direction& a) const { return std::sqrt(inner(a, a)); }

  /// Returns the distance of two states with one active set.
  double distance(const State& a, const State& b) const {
    const auto dx = (a.x - b.x).array();
    const double dlambda = a.lambda - b.lambda;
    return std::sqrt((weights_.array() * dx * dx).sum() + inner_lambda(dlambda, dlambda));
  }

  /// Returns the covector ⟨a, ·⟩.
  Row row(const Direction& a) const {
    return {.dx = weights_.cwiseProduct(a.dx), .dlambda = a.dlambda / (lambda_scale_ * lambda_scale_)};
  }

  /// Returns the dual norm: |apply(row, d)| ≤ dual_norm(row) · norm(d). Entries with weight 0 are left out.
  double dual_norm(const Row& row) const {
    const double scaled = row.dlambda * lambda_scale_;
    return std::sqrt(dual_squared(row.dx) + scaled * scaled);
  }
  double dual_norm(const Vector& dx) const { return std::sqrt(dual_squared(dx)); }

  const Vector& weights() const { return weights_; }
  double lambda_scale() const { return lambda_scale_; }

 private:
  double dual_squared(const Vector& dx) const {
    return (weights_.array() > 0.0).select(dx.array().square() / weights_.array().max(1e-300), 0.0).sum();
  }

  Vector weights_;
  double lambda_scale_;
};

/// Returns the direction scaled to length 1.
inline Direction unit(const Metric& metric, Direction direction) {
  const double scale = 1.0 / metric.norm(direction);
  direction.dx *= scale;
  direction.dlambda *= scale;
  return direction;
}

/// Returns the relative residual: ‖F‖ over the norm of the load at max(|λ|, load_floor) [-].
inline double relative_residual(const Metric& metric, const Linearization& equations, double lambda,
                                double load_floor) {
  const double load = metric.dual_norm(equations.F_lambda) * std::max(std::abs(lambda), load_floor);
  return metric.dual_norm(equations.F) / std::max(load, 1e-300);
}

inline Direction reversed(Direction direction) {
  direction.dx = -direction.dx;
  direction.dlambda = -direction.dlambda;
  return direction;
}

}  // namespace arcwall
