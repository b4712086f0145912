#include "contact/sliding/bounds/clamp.hpp"

#include "contact/sliding/bending.hpp"
#include "contact/sliding/clamps.hpp"

namespace arcwall::sliding {

namespace {

constexpr double nothing_touches = 1.0;  // value of the bound of an end that no obstacle touches

}  // namespace

double ClampBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto end = touched_clamp(setting, at, strand_, last_);
  return end ? end_curvature_gap(setting, at, *end).value * setting.scales.length : nothing_touches;
}

Row ClampBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  if (const auto end = touched_clamp(setting, at, strand_, last_))
    end_curvature_gap(setting, at, *end).add_to(row, setting.scales.length, at.index);
  return row;
}

std::vector<Transition> ClampBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                const Arrival& arrival) const {
  return clamps_are_left(setting, at, arrival.tolerance);
}

}  // namespace arcwall::sliding
