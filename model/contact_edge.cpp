#include "model/contact_edge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace arcwall {

double ContactEdge::value(const State& state) const {
  std::vector<ContactPoint> contacts = contacts_.closed_contacts(state);
  const std::vector<ContactPoint> pressed = contacts_.pressed_nodes(state);
  contacts.insert(contacts.end(), pressed.begin(), pressed.end());
  std::optional<ContactPoint> edge;
  for (const ContactPoint& contact : contacts) {
    if (contact.label.wall != of_.wall || !of_.includes(contact.label.member, contact.label.fraction)) continue;
    const bool before = edge && contact.label.fraction < edge->label.fraction;
    if (!edge || before == (which_ == Which::first)) edge = contact;
  }
  if (!edge) return infinity;
  return what_ == What::arc_length ? edge->label.fraction * length_ : edge->place.x();
}

Row ContactEdge::gradient(const State& state) const {
  constexpr double step_of_lambda = 1e-6;
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (!std::isfinite(value(state))) return row;
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
  const Vector steps = body_.steps(state);
  for (Index i = 0; i < steps.size(); ++i)
    if (steps[i] > 0.0) row.dx[i] = slope(moved.x[i], steps[i]);
  row.dlambda = slope(moved.lambda, step_of_lambda * std::max(1.0, std::abs(state.lambda)));
  return row;
}

}  // namespace arcwall
