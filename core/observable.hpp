#pragma once

#include "core/state.hpp"

namespace arcwall {

/// A scalar that is read off a state: a monitor, a stop rule's quantity, the control of a path.
///
/// `value` and `gradient` are consistent: check_gradient() in core/derivative_check.hpp holds for every implementation.
class Observable {
 public:
  virtual ~Observable() = default;

  virtual double value(const State& state) const = 0;

  /// dx has state.x.size() entries.
  virtual Row gradient(const State& state) const = 0;
};

/// λ itself.
class ParameterValue final : public Observable {
 public:
  double value(const State& state) const override { return state.lambda; }
  Row gradient(const State& state) const override { return {.dx = Vector::Zero(state.x.size()), .dlambda = 1.0}; }
};

}  // namespace arcwall
