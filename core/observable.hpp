#pragma once

#include <memory>
#include <utility>

#include "core/state.hpp"

namespace arcwall {

/// Evaluates a scalar function of the state: a monitor, the quantity of a stop bound, the control of a path.
///
/// gradient() is the derivative of value(); check_gradient() in core/derivative_check.hpp tests it, and rate().
class Observable {
 public:
  virtual ~Observable() = default;

  /// Returns the value, in the unit of the implementation.
  virtual double value(const State& state) const = 0;

  /// Returns the derivative by (x, λ); dx has state.x.size() entries.
  virtual Row gradient(const State& state) const = 0;

  /// Returns the derivative along a direction. Overridden where one direction costs less than all.
  virtual double rate(const State& state, const Direction& direction) const {
    return apply(gradient(state), direction);
  }
};

/// Evaluates the load factor λ.
class ParameterValue final : public Observable {
 public:
  double value(const State& state) const override { return state.lambda; }
  Row gradient(const State& state) const override { return {.dx = Vector::Zero(state.x.size()), .dlambda = 1.0}; }
};

/// Evaluates another quantity times a factor.
class ScaledObservable final : public Observable {
 public:
  ScaledObservable(std::shared_ptr<const Observable> quantity, double factor)
      : quantity_(std::move(quantity)), factor_(factor) {}
  double value(const State& state) const override { return factor_ * quantity_->value(state); }
  Row gradient(const State& state) const override {
    Row row = quantity_->gradient(state);
    row.dx *= factor_;
    row.dlambda *= factor_;
    return row;
  }
  double rate(const State& state, const Direction& direction) const override {
    return factor_ * quantity_->rate(state, direction);
  }

 private:
  std::shared_ptr<const Observable> quantity_;
  double factor_;
};

}  // namespace arcwall
