#pragma once

#include <functional>

#include "core/observable.hpp"

namespace arcwall {

/// The gradient of a value of a state by central differences. `steps` has by how much each unknown is moved; one whose
/// step is 0 has no part in the value. λ is moved by 1e-6 of itself, at least of 1.
Row central_differences(const State& state, const Vector& steps, const std::function<double(const State&)>& value);

/// The derivative of the same value along a direction: by one difference in which no unknown moves by more than its
/// step, and one by λ.
double central_difference_along(const State& state, const Direction& direction, const Vector& steps,
                                const std::function<double(const State&)>& value);

/// A quantity whose derivatives are these differences.
class DifferencedObservable : public Observable {
 public:
  Row gradient(const State& state) const final;
  double rate(const State& state, const Direction& direction) const final;

 protected:
  struct Differences {
    Vector steps{};  ///< as of central_differences()
    std::function<double(const State&)> value{};
  };

  /// How the value changes beside a state.
  virtual Differences differences_at(const State& state) const = 0;
};

}  // namespace arcwall
