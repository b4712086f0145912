#pragma once

#include <algorithm>
#include <stdexcept>

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

/// The number of the bound of a kind of which `holds` is true. There is one, else throws std::logic_error.
template <class Bound, class Holds>
std::size_t bound_number(const SlidingContactLayout& on, const Holds& holds) {
  const auto is_it = [&](const auto& bound) {
    const auto* same = as<Bound>(*bound);
    return same != nullptr && holds(*same);
  };
  const auto found = std::find_if(on.bounds().begin(), on.bounds().end(), is_it);
  if (found == on.bounds().end()) throw std::logic_error("a layout lacks a validity bound that its spans ask for");
  return static_cast<std::size_t>(found - on.bounds().begin());
}

/// An arrival at another bound of the same end, which vanishes together with the one that was passed.
template <class Bound>
Arrival at_bound_of_end(const SlidingState& at, const Arrival& arrival, const StrandEnd& end) {
  const std::size_t number = bound_number<Bound>(at.layout, [&](const Bound& bound) { return bound.end() == end; });
  return {.forward = arrival.forward, .tolerance = arrival.tolerance, .at_hand = at.layout.bounds()[number].get()};
}

}  // namespace arcwall::sliding
