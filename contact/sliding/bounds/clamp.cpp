#include "contact/sliding/bounds/clamp.hpp"

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bound_value.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/clamps.hpp"
#include "contact/sliding/spreading.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

// A hinged end that no obstacle touches never comes to touch one by itself.
double ClampBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto end = touched_clamp(setting, at, strand_, last_);
  if (end) return parting(setting, at, *end);
  return setting.body.is_hinged(strand_, last_) ? no_guard_for_long : no_guard;
}

Row ClampBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto end = touched_clamp(setting, at, strand_, last_);
  return end ? parting_gradient(setting, at, *end) : at.no_slope();
}

BoundPlace ClampBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  BoundPlace place = BoundOfEnd::place(setting, at);
  if (const auto end = touched_clamp(setting, at, strand_, last_)) place.obstacle = end->obstacle;
  return place;
}

std::vector<Transition> ClampBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                const Arrival& arrival) const {
  if (setting.body.is_on_plane(strand_, last_)) return zones_or_arches_from_points(setting, at, arrival);
  const auto clamp = touched_clamp(setting, at, strand_, last_);
  const auto touching = end_nearest_to_lying_down(setting, at, end());
  const bool is_touched = clamp && touching && setting.free_ends[*touching].obstacle == clamp->obstacle;
  if (!is_touched) return clamps_are_left(setting, at, arrival);
  return tips_lie_down(setting, at, at_bound_of_end<LiesDownBound>(at, arrival, end()));
}

}  // namespace arcwall::sliding
