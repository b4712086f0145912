#pragma once

#include <memory>
#include <utility>

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

/// Another quantity times a factor.
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

 private:
  std::shared_ptr<const Observable> quantity_;
  double factor_;
};

}  // namespace arcwall
