#include "contact/sliding/bounds/pulling_jump.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/pulling_jumps.hpp"

namespace arcwall::sliding {

double PullingJumpBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  constexpr double far = 1.0;
  const auto ahead = pulling_jump_ahead(setting, at, point_);
  return ahead ? ahead->distance.value / setting.scales.length : far;
}

Row PullingJumpBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const auto ahead = pulling_jump_ahead(setting, at, point_);
  if (!ahead) return row;
  const Touch touch = touch_of_contact(setting, at.layout, point_);
  const double scale = 1.0 / setting.scales.length;
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), scale * ahead->distance.gradient, row.dx);
  row.dlambda = scale * ahead->distance.rate;
  return row;
}

std::vector<Transition> PullingJumpBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                      const Arrival&) const {
  return edge_lifts_off(setting, at, point_);
}

}  // namespace arcwall::sliding
