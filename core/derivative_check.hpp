#pragma once

#include <string>

#include "core/observable.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// Stores the differences between analytic derivatives and central differences [-].
struct DerivativeReport {
  double K = 0.0;               ///< ∂F/∂x, relative to its greatest entry
  double F_lambda = 0.0;        ///< ∂F/∂λ, relative
  double consistency = 0.0;     ///< F of linearize() against residual(), relative
  double energy = 0.0;          ///< ∂energy/∂x against F, relative; 0 with multipliers
  double guard_gradient = 0.0;  ///< all guards, relative to the greatest entry of each gradient

  double worst() const;
};

/// Compares K, F_λ and all guard gradients with fourth-order central differences of step `step` · (1 + |x|). Compares
/// the energy only without multipliers, where F is its gradient.
DerivativeReport check_derivatives(const UnilateralSystem& system, const State& state, double step = 1e-4);

/// Returns the largest difference between gradient and central differences, relative to the gradient's largest entry,
/// or that between rate and gradient along a direction, relative to the sum of its parts if that is larger.
double check_gradient(const Observable& observable, const State& state, double step = 1e-4);

}  // namespace arcwall
