#include "contact/sliding/bounds/end_stays.hpp"

#include "contact/sliding/lying.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

Touch touch_of(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last) {
  const std::size_t obstacle = at.layout.lies_on(strand).value();
  return touch_of_end(setting, at.layout, {.strand = strand, .last = last, .obstacle = obstacle});
}

}  // namespace

double EndStaysBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return -face_gap(setting, touch_of(setting, at, strand_, last_), at) / setting.scales.length;
}

Row EndStaysBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const Touch touch = touch_of(setting, at, strand_, last_);
  const NodeFunction gap = touch_gap(setting, touch, at).gap;
  Row row = at.no_slope();
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), -gap.gradient / setting.scales.length, row.dx);
  row.dlambda = -gap.rate / setting.scales.length;
  return row;
}

std::vector<Transition> EndStaysBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  return peels_off(setting, at, strand_, arrival.tolerance);
}

}  // namespace arcwall::sliding
