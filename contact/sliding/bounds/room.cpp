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

std::vector<Transition> RoomBound::transitions(const SlidingSetting&, const SlidingState&, const Arrival&) const {
  return {unsupported("a contact point reached the end of its member, or another wall's contact")};
}

}  // namespace arcwall::sliding
