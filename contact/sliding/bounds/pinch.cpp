#include "contact/sliding/bounds/pinch.hpp"

#include "contact/sliding/pinches.hpp"
#include "contact/sliding/remeshing.hpp"

namespace arcwall::sliding {

double PinchBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const std::size_t obstacle = obstacles_at(setting, at.layout, point_)[other_ ? 1 : 0];
  return curvature_gap_beside(setting, at, point_, obstacle, side_).value * setting.scales.length;
}

Row PinchBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  const std::size_t obstacle = obstacles_at(setting, at.layout, point_)[other_ ? 1 : 0];
  curvature_gap_beside(setting, at, point_, obstacle, side_).add_to(row, setting.scales.length, at.index);
  return row;
}

std::vector<Transition> PinchBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                const Arrival&) const {
  const std::vector<std::size_t> touched = obstacles_at(setting, at.layout, point_);
  return {unsupported("a member that walls " + setting.obstacles[touched[0]].name + " and " +
                      setting.obstacles[touched[1]].name + " hold between them bends round one of them")};
}

}  // namespace arcwall::sliding
