#include "contact/sliding/bounds/holding_moment.hpp"

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/lying.hpp"

namespace arcwall::sliding {

double HoldingMomentBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  return holding_moment(setting, at, tip_).value / (setting.scales.force * setting.scales.length);
}

Row HoldingMomentBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  Row row = holding_moment(setting, at, tip_).row;
  const double scale = setting.scales.force * setting.scales.length;
  row.dx /= scale;
  row.dlambda /= scale;
  return row;
}

std::vector<Transition> HoldingMomentBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                        const Arrival& arrival) const {
  if (auto leave = strands_leave(setting, at, arrival)) return {std::move(*leave)};
  const SlidingContactLayout::PressedTip& end = at.layout.pressed_tips()[tip_];
  return peels_off(setting, at, end.strand, {end.position > 0});
}

}  // namespace arcwall::sliding
