#include "contact/sliding/bounds/tip_presses.hpp"

#include <vector>

#include "contact/sliding/lifting.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

constexpr double off_its_obstacle = -1.0;  // value where the tip does not touch and the part is pressed up to it

}  // namespace

double TipPressesBound::value(const SlidingSetting& setting, const SlidingState& at) const {
  const auto contact = pressed_contact(setting, at, end());
  if (!contact) return off_its_obstacle;
  const double hardly_lifts = setting.scales.slack / setting.scales.force + zero_force;
  return presses_end(setting, at, setting.free_ends[*contact].seen_from(end())) / setting.scales.force + hardly_lifts;
}

Row TipPressesBound::gradient(const SlidingSetting& setting, const SlidingState& at) const {
  const auto contact = pressed_contact(setting, at, end());
  if (!contact) return at.no_slope();
  Row row = presses_end_gradient(setting, at, setting.free_ends[*contact].seen_from(end()));
  row.dx /= setting.scales.force;
  row.dlambda /= setting.scales.force;
  return row;
}

std::vector<Transition> TipPressesBound::transitions(const SlidingSetting& setting, const SlidingState& at,
                                                     const Arrival& arrival) const {
  if (setting.body.is_on_plane(strand_, last_)) return load_at_plane_lifts_off(setting, at, end(), arrival);
  std::vector<StrandEnd> lifted;
  for (const TipPressesBound* bound : reached<TipPressesBound>(setting, at, arrival))
    if (bound->end().strand == strand_) lifted.push_back(bound->end());
  return peel_off_from_tips(setting, at, lifted, true);
}

}  // namespace arcwall::sliding
