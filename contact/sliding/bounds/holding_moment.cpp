#include "contact/sliding/bounds/holding_moment.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/lying.hpp"
#include "contact/sliding/placed_bound.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

using Against = HoldingMomentBound::Against;

bool is_on_curve(const SlidingSetting& setting, const SlidingState& at, std::size_t tip) {
  const Touch touch = touch_of_tip(setting, at.layout.pressed_tips()[tip]);
  return setting.obstacles[touch.obstacle].surface->curvature(touch.axis(at).position, at.now.lambda).value != 0.0;
}

// The moment from that where a half, or three, of what the pressure makes of it are left.
HoldingMoment reserve(const SlidingSetting& setting, const SlidingState& at, std::size_t tip, Against what) {
  HoldingMoment moment = holding_moment(setting, at, tip, what == Against::pulling ? 1.0 : 3.0);
  const double sign = what == Against::pulling ? 1.0 : -1.0, scale = setting.scales.force * setting.scales.length;
  moment.value *= sign / scale;
  moment.row.dx *= sign / scale;
  moment.row.dlambda *= sign / scale;
  return moment;
}

}  // namespace

double HoldingMomentBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return is_on_curve(setting, at, tip_) ? no_guard : reserve(setting, at, tip_, against_).value;
}

Row HoldingMomentBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  return is_on_curve(setting, at, tip_) ? at.no_slope() : reserve(setting, at, tip_, against_).row;
}

BoundPlace HoldingMomentBound::place(const SlidingSetting& setting, const SlidingState& at) const {
  const SlidingContactLayout::PressedTip& tip = at.layout.pressed_tips()[tip_];
  BoundPlace place = place_of_end(setting, at, {.strand = tip.strand, .last = tip.position > 0});
  place.obstacle = tip.obstacle;
  return place;
}

std::vector<Transition> HoldingMomentBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                        const Arrival& arrival) const {
  if (auto leave = strands_leave(setting, at, arrival)) return {std::move(*leave)};
  const SlidingContactLayout::PressedTip& end = at.layout.pressed_tips()[tip_];
  const StrandEnd of{.strand = end.strand, .last = end.position > 0};
  if (setting.body.is_tip(of.strand, of.last))
    return peel_off_from_tips(setting, at, {of}, against_ == Against::lifting);
  return peels_off(setting, at, of.strand, {of.last});
}

}  // namespace arcwall::sliding
