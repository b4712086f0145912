#pragma once

#include "contact/sliding/validity_bound.hpp"
#include "core/observable.hpp"

namespace arcwall::sliding {

/// The value of a bound, by its number in the layout of the states that it is asked about.
class BoundValue final : public Observable {
 public:
  BoundValue(const SlidingSetting& setting, std::size_t bound) : setting_(setting), bound_(bound) {}
  double value(const State& state) const override {
    const SlidingState at(state);
    return at.layout.bounds()[bound_]->value(setting_, at);
  }
  Row gradient(const State& state) const override {
    const SlidingState at(state);
    return at.layout.bounds()[bound_]->gradient(setting_, at);
  }

 private:
  const SlidingSetting& setting_;
  std::size_t bound_;
};

}  // namespace arcwall::sliding
