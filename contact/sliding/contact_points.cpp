#include "contact/sliding/contact_points.hpp"

#include <algorithm>

#include "contact/sliding/part_loads.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/touch.hpp"
#include "contact/sliding/validity_bound.hpp"

namespace arcwall::sliding {

namespace {

ContactLabel label_of(const SlidingSetting& setting, std::size_t obstacle, const MaterialPoint& at) {
  const auto [member, fraction] = setting.body.label(at);
  return {.wall = setting.obstacles[obstacle].name, .member = member, .fraction = fraction};
}

ContactPoint at_node(const SlidingSetting& setting, const SlidingState& at, const Touch& touch, double force) {
  const Obstacle& obstacle = *setting.obstacles[touch.obstacle].surface;
  const double s = at.mesh.coordinate(touch.strand, touch.position, at.now.s);
  ContactPoint contact{.label = label_of(setting, touch.obstacle, {.strand = touch.strand, .s = s}),
                       .place = face(touch.offset, touch.axis(at)),
                       .force = force};
  if (!obstacle.faces(contact.place, at.now.lambda)) return contact;
  const Vec2 normal = obstacle.normal(contact.place, at.now.lambda);
  contact.force_vector = force * normal;
  contact.place -= obstacle.half_height() * normal;
  return contact;
}

// What a bound watches.
ContactPoint at_bound(const SlidingSetting& setting, const SlidingState& at, const ValidityBound& bound) {
  const BoundPlace watched = bound.place(setting, at);
  const AxisPlace axis = at.mesh.place(watched.at, at.now);
  if (!watched.obstacle) {
    const auto [member, fraction] = setting.body.label(watched.at);
    return {.label = {.member = member, .fraction = fraction}, .place = axis.position};
  }
  const std::size_t obstacle = *watched.obstacle;
  const Obstacle& surface = *setting.obstacles[obstacle].surface;
  const Vec2 place = face(setting.face_offset(obstacle, watched.at.strand), axis);
  ContactPoint contact{.label = label_of(setting, obstacle, watched.at), .place = place};
  if (surface.faces(place, at.now.lambda))
    contact.place -= surface.half_height() * surface.normal(place, at.now.lambda);
  return contact;
}

// Of the two obstacles of a pinch each is told to push with what is positive of the force across the axis in its
// direction. The couple that they make besides has no place of its own.
ContactPoint at_pinch(const SlidingSetting& setting, const SlidingState& at, std::size_t j, bool other) {
  Touch touch = touch_of_contact(setting, at.layout, j);
  touch.obstacle = obstacles_at(setting, at.layout, j)[other ? 1 : 0];
  touch.offset = setting.face_offset(touch.obstacle, touch.strand);
  const PinchingForce force = pinching_force(setting, at, j);
  const bool presses = other ? force.value < 0.0 : force.value > 0.0;
  ContactPoint contact = at_node(setting, at, touch, presses ? std::abs(force.value) : 0.0);
  contact.force_vector = presses ? force.vector : Vec2::Zero();
  return contact;
}

void add_friction(const SlidingSetting& setting, const SlidingState& at, std::size_t j, ContactPoint& contact) {
  const NodeFunction place = touched_place(setting, touch_of_contact(setting, at.layout, j), at, 0.0);
  contact.friction = FrictionOfContact{.mode = at.layout.rubbing(j).mode,
                                       .force = at.state.x[*at.index.friction(j)],
                                       .coefficient = friction_coefficient(setting, at.layout, j),
                                       .slip = slip_of(setting, at, j),
                                       .tangent = place.gradient.head<2>().normalized()};
  contact.force_vector += contact.friction->force * contact.friction->tangent;
  if (contact.friction->mode == ContactMode::sticks) contact.friction->anchor = contact.place.x();
}

// Of the pressed parts that end at a closed contact, on its wall.
std::vector<PressureAtEnd> pressures_at(const SlidingSetting& setting, const SlidingState& at, std::size_t j) {
  std::vector<PressureAtEnd> pressures;
  if (!at.is_closed(j) || at.layout.is_pinched(j)) return pressures;
  const Touch touch = touch_of_contact(setting, at.layout, j);
  const auto node_of = [&](Index point) { return at.mesh.breakpoint(point).second; };
  for (std::size_t i = 0; i < at.layout.segments().size(); ++i) {
    const SlidingContactLayout::Segment& part = at.layout.segments()[i];
    if (part.span != SlidingContactLayout::Span::pressed || part.strand != touch.strand ||
        obstacle_of_part(at, i) != touch.obstacle)
      continue;
    const bool begins = part.place == 0, ends = part.last_point < 0 && part.last_load < 0;
    if (part.first_point >= 0 ? node_of(part.first_point) == touch.position : begins && touch.position == 0)
      pressures.push_back(pressure_at_end(setting, at, i, false));
    const Index last = at.mesh.nodes(part.strand) - 1;
    if (part.last_point >= 0 ? node_of(part.last_point) == touch.position : ends && touch.position == last)
      pressures.push_back(pressure_at_end(setting, at, i, true));
  }
  return pressures;
}

// What acts at a closed contact alone, without the pressure beside it.
ContactPoint at_closed(const SlidingSetting& setting, const SlidingState& at, std::size_t j) {
  const std::vector<PressureAtEnd> pressures = pressures_at(setting, at, j);
  if (pressures.empty()) return contact_point(setting, at, j);
  double force = at.force(j);
  for (const PressureAtEnd& pressure : pressures) force -= pressure.force;
  return at_node(setting, at, touch_of_contact(setting, at.layout, j), force);
}

}  // namespace

ContactPoint contact_point(const SlidingSetting& setting, const SlidingState& at, std::size_t j) {
  if (at.layout.is_pinched(j)) return at_pinch(setting, at, j, false);
  if (j < at.contacts()) {
    ContactPoint contact = at_node(setting, at, touch_of_contact(setting, at.layout, j), at.force(j));
    if (at.rubs(j)) add_friction(setting, at, j, contact);
    return contact;
  }
  return at_bound(setting, at, *at.layout.bounds()[j - at.contacts()]);
}

std::vector<ContactPoint> closed_contacts(const SlidingSetting& setting, const SlidingState& at) {
  std::vector<ContactPoint> contacts;
  for (std::size_t j = 0; j < at.contacts(); ++j) {
    if (!at.is_closed(j)) continue;
    contacts.push_back(at_closed(setting, at, j));
    if (at.layout.is_pinched(j)) contacts.push_back(at_pinch(setting, at, j, true));
  }
  return contacts;
}

std::vector<ContactPoint> pressed_nodes(const SlidingSetting& setting, const SlidingState& at) {
  std::vector<ContactPoint> nodes;
  for (std::size_t i = 0; i < at.layout.pressed_nodes().size(); ++i) {
    const Touch touch = touch_of_node(setting, at.layout.pressed_nodes()[i]);
    const auto coordinate = [&](Index position) { return at.mesh.coordinate(touch.strand, position, at.now.s); };
    ContactPoint node = at_node(setting, at, touch, at.pressed_force(i));
    node.label.tributary = 0.5 * (coordinate(touch.position + 1) - coordinate(touch.position - 1));
    nodes.push_back(std::move(node));
  }
  for (std::size_t j = 0; j < at.contacts(); ++j)
    for (const PressureAtEnd& pressure : pressures_at(setting, at, j)) {
      ContactPoint end = at_node(setting, at, touch_of_contact(setting, at.layout, j), pressure.force);
      end.label.tributary = pressure.length;
      nodes.push_back(std::move(end));
    }
  return nodes;
}

}  // namespace arcwall::sliding
