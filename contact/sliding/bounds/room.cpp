#include "contact/sliding/bounds/room.hpp"

#include "contact/sliding/bounds/element_size.hpp"
#include "contact/sliding/remeshing.hpp"

namespace arcwall::sliding {

double RoomBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted(setting, at, segment_) - 0.5;
}

Row RoomBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return elements_wanted_gradient(setting, at, segment_, 1.0);
}

bool RoomBound::is_beside(const SlidingContactLayout& on, Index point) const {
  const SlidingContactLayout::Segment& segment = on.segments()[segment_];
  return segment.first_point == point || segment.last_point == point;
}

// Of open points the one behind is given up first: if both are, the other's bound says so next.
std::vector<Transition> RoomBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                               const Arrival& arrival) const {
  const SlidingContactLayout::Segment& segment = at.layout.segments()[segment_];
  for (const Index k : {segment.last_point, segment.first_point}) {
    const auto point = static_cast<std::size_t>(k);
    if (k < 0 || at.is_closed(point)) continue;
    return {without_point(setting, at, arrival.forward, point)};
  }
  return {unsupported("a contact point reached the end of its member, or a contact with another wall")};
}

}  // namespace arcwall::sliding
