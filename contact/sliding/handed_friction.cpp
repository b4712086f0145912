#include "contact/sliding/handed_friction.hpp"

#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

double coordinate_of(const SlidingState& at, const Touch& touch) {
  return at.mesh.coordinate(touch.strand, touch.position, at.now.s);
}

// A contact where it is, as a point of its strand: the anchor of a point that goes on from there.
HandedFriction friction_here(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  HandedFriction here;
  if (at.rubs(contact)) {
    here.rubbing = anchored_anew(setting, at, contact);
    here.force = at.state.x[*at.index.friction(contact)];
    here.held = at.state.x[*at.index.place(contact)];
  } else if (setting.body.is_on_plane(touch.strand, touch.position > 0)) {
    // What is as great on both sides of a plane of symmetry is 0 in it.
    here.rubbing.mode = ContactMode::sticks;
    here.rubbing.w = here.held = touched_place(setting, touch, at, 0.0).value;
  }
  here.rubbing.s = coordinate_of(at, touch);
  here.rubbing.stretch = mean_stretch(setting, at, contact);
  return here;
}

}  // namespace

void HandedFriction::give_to_point(std::size_t point, double part, LayoutEdit& edit) const {
  edit.points[point].rubbing = rubbing;
  edit.frictions[point] = part * force;
  edit.held[point] = held;
}

void HandedFriction::give_to_end(std::size_t end, double part, LayoutEdit& edit) const {
  edit.end_rubbings[end] = rubbing;
  edit.end_frictions[end] = part * force;
  edit.ends_held[end] = held;
}

HandedFriction friction_of_point_at(const SlidingSetting& setting, const SlidingState& at, std::size_t contact,
                                    double s) {
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  const bool on_plane = !at.rubs(contact) && setting.body.is_on_plane(touch.strand, touch.position > 0);
  const double coefficient = setting.obstacles[touch.obstacle].friction(touch.strand);
  if (coefficient == 0.0 || (!on_plane && coefficient != friction_coefficient(setting, at.layout, contact))) return {};
  HandedFriction moved = friction_here(setting, at, contact);
  moved.held += body_sense(setting, at, contact) * moved.rubbing.stretch * (s - moved.rubbing.s);
  return moved;
}

HandedFriction friction_of_end(const SlidingSetting& setting, const SlidingState& at, std::size_t point,
                               const FreeEnd& end) {
  const double coefficient = setting.obstacles[end.obstacle].friction_at_end(end.strand, end.last);
  if (coefficient == 0.0 || coefficient != friction_coefficient(setting, at.layout, point)) return {};
  HandedFriction moved = friction_of_point_at(setting, at, point, end.last ? setting.body.length(end.strand) : 0.0);
  moved.rubbing.w = moved.held;
  moved.rubbing.s = moved.rubbing.stretch = 0.0;
  return moved;
}

HandedFriction merged(const HandedFriction& one, const HandedFriction& other, ContactMode mode, double s) {
  if (!one.rubbing.rubs() || !other.rubbing.rubs()) return {};
  HandedFriction both = one;
  both.force += other.force;
  both.held = 0.5 * (one.held + other.held);
  both.rubbing.mode = mode;
  both.rubbing.w = both.held;
  both.rubbing.s = s;
  both.rubbing.stretch = 0.5 * (one.rubbing.stretch + other.rubbing.stretch);
  both.rubbing.slipped = 0.5 * (one.rubbing.slipped + other.rubbing.slipped);
  return both;
}

}  // namespace arcwall::sliding
