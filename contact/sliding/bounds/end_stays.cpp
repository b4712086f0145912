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

// Both ends stay where the obstacle is as long as neither leaves it.
std::vector<Transition> EndStaysBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                   const Arrival& arrival) const {
  std::vector<bool> ends;
  std::vector<Index> numbers;  // of their bounds among the guards
  for (std::size_t i = 0; i < at.layout.bounds().size(); ++i) {
    const auto* bound = as<EndStaysBound>(*at.layout.bounds()[i]);
    if (bound == nullptr || bound->strand() != strand_) continue;
    if (bound != this && !(apply(bound->gradient(setting, at), arrival.forward) < 0.0)) continue;
    ends.push_back(bound->last());
    numbers.push_back(static_cast<Index>(at.contacts() + i));
  }
  std::vector<Transition> transitions = peels_off(setting, at, strand_, ends);
  for (Transition& transition : transitions) transition.contacts = numbers;
  return transitions;
}

}  // namespace arcwall::sliding
