#include "contact/sliding/bounds/pulling_jump.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/pulling_jumps.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

double PullingJumpBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto beside = pulling_jump_beside(setting, at, point_);
  return beside ? beside->room(setting.scales) : no_guard;
}

Row PullingJumpBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto beside = pulling_jump_beside(setting, at, point_);
  return beside ? room_gradient(setting, at, point_, *beside) : at.no_slope();
}

std::vector<Transition> PullingJumpBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                      const Arrival& arrival) const {
  return edge_lifts_off(setting, at, point_, arrival);
}

}  // namespace arcwall::sliding
