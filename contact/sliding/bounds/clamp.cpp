#include "contact/sliding/bounds/clamp.hpp"

#include "contact/sliding/bending.hpp"
#include "contact/sliding/clamps.hpp"

namespace arcwall::sliding {

namespace {

constexpr double nothing_touches = 1.0;  // value of the bound of an end that no obstacle touches

}  // namespace

double ClampBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto end = touched_clamp(setting, at, strand_, last_);
  return end ? parting(setting, at, *end) : nothing_touches;
}

Row ClampBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto end = touched_clamp(setting, at, strand_, last_);
  return end ? parting_gradient(setting, at, *end) : at.no_slope();
}

std::vector<Transition> ClampBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                const Arrival& arrival) const {
  return clamps_are_left(setting, at, arrival.tolerance);
}

}  // namespace arcwall::sliding
