#include "model/contact_edge.hpp"

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
    if (!of_.includes(contact.label)) continue;
    const bool before = edge && contact.label.fraction < edge->label.fraction;
    if (!edge || before == (which_ == Which::first)) edge = contact;
  }
  if (!edge) return infinity;
  return what_ == What::arc_length ? edge->label.fraction * length_ : edge->place.x();
}

DifferencedObservable::Differences ContactEdge::differences_at(const State& state) const {
  if (!std::isfinite(value(state))) return {.value = [](const State&) { return 0.0; }};
  return {.steps = body_.steps(state), .value = [this](const State& moved) { return value(moved); }};
}

}  // namespace arcwall
