#include "contact/sliding/contact_points.hpp"

#include <algorithm>

#include "contact/sliding/pinches.hpp"
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

}  // namespace

ContactPoint contact_point(const SlidingSetting& setting, const SlidingState& at, std::size_t j) {
  if (at.layout.is_pinched(j)) return at_pinch(setting, at, j, false);
  if (j < at.contacts()) return at_node(setting, at, touch_of_contact(setting, at.layout, j), at.force(j));
  return at_bound(setting, at, *at.layout.bounds()[j - at.contacts()]);
}

std::vector<ContactPoint> closed_contacts(const SlidingSetting& setting, const SlidingState& at) {
  std::vector<ContactPoint> contacts;
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (at.is_closed(j)) {
      contacts.push_back(contact_point(setting, at, j));
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
  return nodes;
}

}  // namespace arcwall::sliding
