#include "contact/sliding/clamps.hpp"

#include <cmath>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bound_value.hpp"
#include "contact/sliding/bounds/clamp.hpp"
#include "contact/sliding/bounds/free_end.hpp"
#include "contact/sliding/bounds/tail.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;
using Change = Transition::Change;

// The bounds of clamps that are reached together.
using Clamps = std::vector<const ClampBound*>;

// Whether an end of a strand is on an obstacle: if it is clamped, parallel to it; if it may turn, a straight one. On a
// plane of symmetry it is a contact that is closed.
bool is_on(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  if (setting.body.is_on_plane(end.strand, end.last)) {
    const auto contact = setting.number_of_end({.strand = end.strand, .last = end.last}, end.obstacle);
    return contact && at.is_closed(at.layout.points().size() + *contact) && is_tangent_at_plane(setting, at, end);
  }
  const Touch touch = touch_of_end(setting, at.layout, end);
  if (!(std::abs(face_gap(setting, touch, at)) <= touching_at_rest * setting.scales.length)) return false;
  if (setting.body.is_hinged(end.strand, end.last)) return setting.obstacles[end.obstacle].surface->knots().empty();
  return std::abs(touch_gap(setting, touch, at).tilt.value) <= touching_at_rest;
}

// Pressed parts of one length from the clamps on.
Transition with_parts(const SlidingSetting& setting, const SlidingState& at, const Clamps& clamps, double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  for (const ClampBound* clamp : clamps) {
    const auto [strand, last] = std::pair(clamp->strand(), clamp->last());
    const std::size_t obstacle = touched_clamp(setting, at, strand, last).value().obstacle;
    const double s = last ? setting.body.length(strand) - length : length;
    const int part = elements_asked(setting.body, strand, std::min(s, s + length), std::max(s, s + length), 2);
    edit.insert_near_end({strand, last}, s, obstacle, Span::pressed, Span::free, part);
  }
  const auto on = layout_of(edit);
  const ClampBound& first = *clamps.front();
  const double coordinate = first.last() ? setting.body.length(first.strand()) : 0.0;
  const std::size_t point = on->point_at_end(first.strand(), first.last()).value();
  Transition transition = up_to(length, std::make_shared<TailLength>(point, coordinate), Change::spreads,
                                mapped_onto(setting, at, edit, on));
  for (const ClampBound* clamp : clamps) {
    const std::size_t i = bound_number<ClampBound>(at.layout, [&](const ClampBound& other) { return &other == clamp; });
    transition.contacts.push_back(static_cast<Index>(at.contacts() + i));
  }
  return transition;
}

}  // namespace

double parting(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  if (setting.body.is_hinged(end.strand, end.last)) return sine_from_end(setting, at, end);
  return end_curvature_gap(setting, at, end) * setting.scales.length;
}

Row parting_gradient(const SlidingSetting& setting, const SlidingState& at, const FreeEnd& end) {
  if (setting.body.is_hinged(end.strand, end.last)) return sine_from_end_gradient(setting, at, end);
  Row row = at.no_slope();
  end_curvature_gap_gradient(setting, at, end).add_to(row, setting.scales.length, at.index);
  return row;
}

std::optional<FreeEnd> touched_clamp(const SlidingSetting& setting, const SlidingState& at, Index strand, bool last) {
  if (at.layout.span_at_end(strand, last) != Span::free) return std::nullopt;
  std::optional<FreeEnd> found;
  double least = infinity;
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
    const FreeEnd end{.strand = strand, .last = last, .obstacle = w};
    if (!setting.obstacles[w].concerns(strand) || !is_on(setting, at, end)) continue;
    const double gap = parting(setting, at, end);
    if (gap >= least) continue;
    least = gap;
    found = end;
  }
  return found;
}

std::vector<Transition> clamps_are_left(const SlidingSetting& setting, const SlidingState& at, const Arrival& arrival) {
  const Clamps clamps = reached<ClampBound>(setting, at, arrival);
  const double length = 2.0 * shortest_span(setting.body, clamps.front()->strand());
  return {
      with_parts(setting, at, clamps, length),
      unsupported("a member comes into contact with a wall from its fixed end on, but no equilibrium with that contact "
                  "was found")};
}

std::vector<Transition> parts_gather_at_clamps(const SlidingSetting& setting, const SlidingState& at,
                                               const Arrival& arrival) {
  std::vector<const TailBound*> parts;
  for (const TailBound* bound : reached<TailBound>(setting, at, arrival))
    if (bound->gathers_at_support(setting, at)) parts.push_back(bound);
  LayoutEdit edit = edit_of(setting.body, at);
  const auto end_on_plane = [&](const TailBound& part) -> std::optional<std::size_t> {
    if (!setting.body.is_on_plane(part.strand(), part.last())) return std::nullopt;
    return setting.number_of_end({.strand = part.strand(), .last = part.last()},
                                 at.layout.points()[part.point()].obstacle);
  };
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    const std::size_t point = (*part)->point();
    if (const auto end = end_on_plane(**part)) {
      edit.ends_closed[*end] = 1;
      edit.end_forces[*end] += edit.forces[point];
    }
    edit.erase(point, (*part)->last() ? edit.elements_before(point) : edit.elements_behind(point));
  }
  const auto on = layout_of(edit);
  Transition transition = up_to(0.0, nullptr, Change::gathers, mapped_onto(setting, at, edit, on));
  for (const TailBound* part : parts) {
    const std::size_t i = bound_number<ClampBound>(
        *on, [&](const ClampBound& clamp) { return clamp.strand() == part->strand() && clamp.last() == part->last(); });
    if (!transition.quantity) transition.quantity = std::make_shared<BoundValue>(setting, i);
    const auto end = end_on_plane(*part);
    transition.contacts.push_back(
        static_cast<Index>(end ? on->points().size() + *end : transition.guess.get().active_set.size() + i));
  }
  return {
      transition,
      unsupported("the contact zone at a fixed end shrinks to zero length, but no equilibrium without it was found")};
}

}  // namespace arcwall::sliding
