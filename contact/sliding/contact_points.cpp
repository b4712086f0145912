#include "contact/sliding/contact_points.hpp"

#include <algorithm>

#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/end_stays.hpp"
#include "contact/sliding/bounds/load.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/bounds/pulling_jump.hpp"
#include "contact/sliding/clamps.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/touch.hpp"

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

// Where the pressure is least that a bound watches.
ContactPoint at_least_pressure(const SlidingSetting& setting, const SlidingState& at, const PressureBound& bound) {
  const SlidingContactLayout::PressedNode& node = at.layout.pressed_nodes()[bound.node()];
  const MaterialPoint least{.strand = node.strand, .s = least_pressure(setting, at, bound.node()).s};
  return {.label = label_of(setting, node.obstacle, least),
          .place = face(setting.face_offset(node.obstacle, node.strand), at.mesh.place(least, at.now))};
}

// Where a load pulls a part off.
ContactPoint at_load(const SlidingSetting& setting, const SlidingState& at, const PartLoad& load) {
  const std::size_t obstacle = obstacle_of_part(at, load.segment);
  const MaterialPoint here{.strand = load.strand, .s = place_of(setting, load)};
  return {.label = label_of(setting, obstacle, here),
          .place = face(setting.face_offset(obstacle, load.strand), at.mesh.place(here, at.now))};
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
  const ValidityBound& bound = *at.layout.bounds()[j - at.contacts()];
  if (const auto* clamp = dynamic_cast<const ClampBound*>(&bound))
    return at_node(setting, at,
                   touch_of_end(setting, at.layout, touched_clamp(setting, at, clamp->strand(), clamp->last()).value()),
                   0.0);
  if (const auto* stays = dynamic_cast<const EndStaysBound*>(&bound)) {
    const std::size_t obstacle = at.layout.lies_on(stays->strand()).value();
    return at_node(
        setting, at,
        touch_of_end(setting, at.layout, {.strand = stays->strand(), .last = stays->last(), .obstacle = obstacle}),
        0.0);
  }
  if (const auto* jump = dynamic_cast<const PullingJumpBound*>(&bound))
    return at_node(setting, at, touch_of_contact(setting, at.layout, jump->point()), 0.0);
  if (const auto* presses = dynamic_cast<const LoadPressesBound*>(&bound)) return at_load(setting, at, presses->load());
  return at_least_pressure(setting, at, dynamic_cast<const PressureBound&>(bound));
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
