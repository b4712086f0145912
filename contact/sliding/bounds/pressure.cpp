#include "contact/sliding/bounds/pressure.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/pressed_part.hpp"

namespace arcwall::sliding {

double PressureBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return least_pressure(at, node_).value * setting.scales.length / setting.scales.force;
}

// The place of the least pressure moves, which at a least one, or at the end of its range, has no part in this.
Row PressureBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const LeastPressure least = least_pressure(at, node_);
  const SlidingContactLayout::Segment& part = at.layout.segments()[at.layout.pressed_nodes()[node_].segment];
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  const double length = to - from;
  const double per_force = setting.scales.length * part.elements / (length * setting.scales.force);
  const Index first = at.index.pressed_force(least.first), count = least.weights.size();
  const double p = least.weights.dot(at.state.x.segment(first, count));
  Row row = at.no_slope();
  row.dx.segment(first, count) = per_force * least.weights;
  if (part.last_point >= 0) row.dx[at.index.coordinate(part.last_point)] = -per_force * p / length;
  if (part.first_point >= 0) row.dx[at.index.coordinate(part.first_point)] = per_force * p / length;
  return row;
}

std::vector<Transition> PressureBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return parts_lift_off(setting, at, arrival.tolerance);
}

}  // namespace arcwall::sliding
