#include "model/dissipation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace arcwall {

namespace {

// Hermite's cubic on [0, 1].
struct Cubic {
  double from, from_rate, to, to_rate;

  double value(double u) const {
    const double v = 1.0 - u;
    return v * v * ((1.0 + 2.0 * u) * from + u * from_rate) + u * u * ((1.0 + 2.0 * v) * to - v * to_rate);
  }
  double slope(double u) const {
    const double v = 1.0 - u;
    return 6.0 * u * v * (to - from) + v * (1.0 - 3.0 * u) * from_rate + u * (1.0 - 3.0 * v) * to_rate;
  }
};

// Gauss' points and weights on [0, 1], exact up to degree 5: T has 3, the rate of w 2. Λ is nearly constant.
constexpr std::array<std::pair<double, double>, 3> gauss{
    {{0.5 - 0.3872983346207417, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + 0.3872983346207417, 5.0 / 18.0}}};

}  // namespace

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
                     .rates = in_users_unit(contacts->place_rates(state, direction, j))});
  return slips;
}

double dissipated(const RecordSlip& from, const RecordSlip& to, double arc_length) {
  const auto cubic = [arc_length](double first, double first_rate, double last, double last_rate) {
    return Cubic{.from = first, .from_rate = arc_length * first_rate, .to = last, .to_rate = arc_length * last_rate};
  };
  const auto of_place = [&](double ContactPlace::*part) {
    return cubic(from.place.*part, from.rates.*part, to.place.*part, to.rates.*part);
  };
  const Cubic T = cubic(from.force, from.force_rate, to.force, to.force_rate);
  const Cubic w = of_place(&ContactPlace::w), s = of_place(&ContactPlace::s),
              stretch = of_place(&ContactPlace::stretch);
  double sum = 0.0;
  for (const auto& [u, weight] : gauss) sum -= weight * T.value(u) * (w.slope(u) - stretch.value(u) * s.slope(u));
  return std::max(sum, 0.0);
}

Index slipping_contacts(const RecordPoint& point) {
  return std::count_if(point.forces.begin(), point.forces.end(),
                       [](const RecordForce& contact) { return contact.friction && slips(contact.friction->mode); });
}

double total_dissipation(const RecordPoint& point) {
  return std::accumulate(point.dissipation.begin(), point.dissipation.end(), 0.0);
}

}  // namespace arcwall
