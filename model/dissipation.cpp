#include "model/dissipation.hpp"

#include <algorithm>
#include <numeric>

#include "model/hermite_integral.hpp"

namespace arcwall {

std::vector<RecordSlip> slips_along(const FrictionalContact* contacts, const State& state, const Direction& direction,
                                    double unit) {
  std::vector<RecordSlip> slips;
  if (contacts == nullptr || direction.dx.size() != state.x.size()) return slips;  // where a path ends
  const auto in_users_unit = [unit](ContactPlace place) {
    place.w *= unit;
    place.s *= unit;
    return place;
  };
  for (const Index j : contacts->slipping(state.active_set))
    slips.push_back({.contact = j,
                     .force = contacts->friction_force(state, j),
                     .force_rate = direction.dx[*contacts->friction_index(state.active_set, j)],
                     .place = in_users_unit(contacts->place(state, j)),
                     .rates = in_users_unit(contacts->place_rates(state, direction, j)),
                     .rolls = contacts->rolls(state.active_set, j)});
  return slips;
}

double dissipated(const RecordSlip& from, const RecordSlip& to, double arc_length) {
  const auto cubic = [arc_length](double first, double first_rate, double last, double last_rate) {
    return HermiteCubic{
        .from = first, .from_rate = arc_length * first_rate, .to = last, .to_rate = arc_length * last_rate};
  };
  const auto of_place = [&](double ContactPlace::*part) {
    return cubic(from.place.*part, from.rates.*part, to.place.*part, to.rates.*part);
  };
  const HermiteCubic T = cubic(from.force, from.force_rate, to.force, to.force_rate);
  const HermiteCubic w = of_place(&ContactPlace::w), s = of_place(&ContactPlace::s),
                     stretch = of_place(&ContactPlace::stretch);
  double sum = 0.0;
  for (const auto& [u, weight] : gauss_of_cubics)
    sum -= weight * T.value(u) * (w.slope(u) - (from.rolls ? stretch.value(u) * s.slope(u) : 0.0));
  return std::max(sum, 0.0);
}

void add_dissipated_before(const FrictionalContact& contacts, const State& event, const State& first, double unit,
                           std::vector<RecordSlip>& slips) {
  for (RecordSlip& slip : slips)
    slip.before = std::max(-slip.force * unit * contacts.slip_since(event, first, slip.contact), 0.0);
}

Index slipping_contacts(const RecordPoint& point) {
  return std::count_if(point.forces.begin(), point.forces.end(),
                       [](const RecordForce& contact) { return contact.friction && slips(contact.friction->mode); });
}

double total_dissipation(const RecordPoint& point) {
  return std::accumulate(point.dissipation.begin(), point.dissipation.end(), 0.0);
}

}  // namespace arcwall
