#include "contact/sliding/bounds/pressure.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

double PressureBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  if (part_needs_no_pressure(setting, at, at.layout.pressed_nodes()[node_].segment)) return no_guard;
  return least_pressure(setting, at, node_).value * setting.scales.length / setting.scales.force;
}

Row PressureBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  if (part_needs_no_pressure(setting, at, at.layout.pressed_nodes()[node_].segment)) return at.no_slope();
  Row row = least_pressure_gradient(setting, at, node_);
  const double scale = setting.scales.length / setting.scales.force;
  row.dx *= scale;
  row.dlambda *= scale;
  return row;
}

double PressureBound::rate(const SlidingSetting& setting, const SlidingMotion& motion) const {
  if (part_needs_no_pressure(setting, motion.at, motion.at.layout.pressed_nodes()[node_].segment)) return 0.0;
  return least_pressure_rate(setting, motion, node_) * setting.scales.length / setting.scales.force;
}

BoundPlace PressureBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  const SlidingContactLayout::PressedNode& node = at.layout.pressed_nodes()[node_];
  return {.at = {.strand = node.strand, .s = least_pressure(setting, at, node_).s}, .obstacle = node.obstacle};
}

std::vector<Transition> PressureBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return parts_lift_off(setting, at, arrival);
}

}  // namespace arcwall::sliding
