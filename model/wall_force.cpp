#include "model/wall_force.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

double WallForce::of(const ContactPoint& contact) const {
  if (contact.label.wall != wall_) return 0.0;
  const Vec2 arm = contact.place - about_, force = contact.force_vector;
  switch (what_) {
    case What::x:
      return force.x();
    case What::z:
      return force.y();
    case What::moment:
      return cross(arm, force);
  }
  return 0.0;
}

double WallForce::value(const State& state) const {
  double sum = 0.0;
  for (const ContactPoint& contact : contacts_.closed_contacts(state)) sum += of(contact);
  for (const ContactPoint& node : contacts_.pressed_nodes(state)) sum += of(node);
  return sum;
}

// Unknowns with a weight are moved by as much as is alike in the path metric; the others are forces, by a unit.
Row WallForce::gradient(const State& state) const {
  constexpr double relative = 1e-6;
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (contacts_.closed_contacts(state).empty() && contacts_.pressed_nodes(state).empty()) return row;
  State moved = state;
  const auto slope = [&](double& of, double step) {
    const double here = of;
    of = here + step;
    const double above = value(moved);
    of = here - step;
    const double below = value(moved);
    of = here;
    return (above - below) / (2.0 * step);
  };
  const Vector weights = system_.weights(state.active_set);
  const double nodes = std::max(1.0, double(weights.size()) / 3.0);
  for (Index i = 0; i < row.dx.size(); ++i)
    row.dx[i] = slope(moved.x[i], weights[i] > 0.0 ? relative / std::sqrt(nodes * weights[i])
                                                   : relative * std::max(1.0, std::abs(state.x[i])));
  row.dlambda = slope(moved.lambda, relative * std::max(1.0, std::abs(state.lambda)));
  return row;
}

}  // namespace arcwall
