#include "model/friction_at_wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace arcwall {

// |T|/(μ p) of a closed contact: 1 of one that slips, whatever round-off says, and 0 of one that only touches.
double FrictionAtWall::use_of(const State& state, Index j) const {
  if (slips(friction_.mode(state.active_set, j))) return 1.0;
  const double most = friction_.coefficient(state.active_set, j) * contacts_.force(state, j);
  return most > 0.0 ? std::abs(friction_.friction_force(state, j)) / most : 0.0;
}

template <typename Visit>
void FrictionAtWall::for_each(const State& state, const Visit& visit) const {
  for (Index j = 0; j < static_cast<Index>(state.active_set.contacts()); ++j)
    if (friction_.friction_index(state.active_set, j) && of_.includes(contacts_.contact(state, j).label)) visit(j);
}

double FrictionAtWall::value(const State& state) const {
  double sum = 0.0;
  std::optional<double> greatest;
  for_each(state, [&](Index j) {
    switch (what_) {
      case What::force:
        sum += friction_.friction_force(state, j);
        break;
      case What::slip:
        sum += friction_.slip(state, j);
        break;
      case What::greatest_use:
        greatest = std::max(greatest.value_or(0.0), use_of(state, j));
        break;
    }
  });
  return what_ == What::greatest_use ? greatest.value_or(std::numeric_limits<double>::quiet_NaN()) : sum;
}

Row FrictionAtWall::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  std::optional<Index> most_used;
  for_each(state, [&](Index j) {
    if (what_ == What::force) row.dx[*friction_.friction_index(state.active_set, j)] = 1.0;
    if (what_ == What::slip) row.dx += friction_.slip_gradient(state, j).dx;
    if (!most_used || use_of(state, j) > use_of(state, *most_used)) most_used = j;
  });
  if (what_ != What::greatest_use || !most_used || slips(friction_.mode(state.active_set, *most_used))) return row;
  const double T = friction_.friction_force(state, *most_used), p = contacts_.force(state, *most_used);
  const double most = friction_.coefficient(state.active_set, *most_used) * p;
  if (most <= 0.0) return row;
  row.dx[*friction_.friction_index(state.active_set, *most_used)] = (T < 0.0 ? -1.0 : 1.0) / most;
  row.dx[*friction_.force_index(state.active_set, *most_used)] = -std::abs(T) / (most * p);
  return row;
}

Row FrictionPower::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  for (const Index j : friction_.slipping(state.active_set))
    if (wall_.empty() || contacts_.contact(state, j).label.wall == wall_)
      row.dx -= friction_.friction_force(state, j) * friction_.slip_gradient(state, j).dx;
  return row;
}

}  // namespace arcwall
