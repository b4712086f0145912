#include "contact/sliding/bounds/length.hpp"

#include <utility>

#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/shrinking.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

double LengthBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto k = static_cast<Index>(point_);
  return (at.s(k + 1) - at.s(k) - shortest_span(setting, at, point_)) / setting.scales.length;
}

Row LengthBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto k = static_cast<Index>(point_);
  Row row = at.no_slope();
  row.dx[at.index.coordinate(k)] = -1.0 / setting.scales.length;
  row.dx[at.index.coordinate(k + 1)] = 1.0 / setting.scales.length;
  return row;
}

std::vector<Transition> LengthBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                 const Arrival& arrival) const {
  std::vector<Transition> transitions = span_vanishes(setting, at, point_, arrival);
  for (Transition& other : neighbours_vanish(setting, at, arrival.forward, point_))
    transitions.push_back(std::move(other));
  transitions.push_back(
      unsupported("the free span between two contacts closes, but no equilibrium with one merged contact was found"));
  return transitions;
}

}  // namespace arcwall::sliding
