#include "contact/sliding/bounds/pinch.hpp"

#include "contact/sliding/pinches.hpp"
#include "contact/sliding/placed_bound.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

double PinchBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  if (!holds_direction(setting, at.layout, point_)) return angle_to_flank(setting, at, point_, other_, side_).value;
  return curvature_gap_beside(setting, at, point_, other_, side_).value * setting.scales.length;
}

Row PinchBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = at.no_slope();
  if (holds_direction(setting, at.layout, point_)) {
    curvature_gap_beside(setting, at, point_, other_, side_).add_to(row, setting.scales.length, at.index);
    return row;
  }
  const Touch touch = touch_of_contact(setting, at.layout, point_);
  const double by_rotation = angle_to_flank(setting, at, point_, other_, side_).by_rotation;
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), {0.0, 0.0, by_rotation}, row.dx);
  return row;
}

BoundPlace PinchBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  BoundPlace place = place_of_point(at, point_);
  place.obstacle = obstacles_at(setting, at.layout, point_)[other_ ? 1 : 0];
  return place;
}

std::vector<Transition> PinchBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                const Arrival&) const {
  const std::vector<std::size_t> touched = obstacles_at(setting, at.layout, point_);
  return {unsupported("a member between walls " + setting.obstacles[touched[0]].name + " and " +
                      setting.obstacles[touched[1]].name + " bends round one of them")};
}

}  // namespace arcwall::sliding
