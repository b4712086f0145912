#include "apps/output/event_marks.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace arcwall {

namespace {

// Corners at equal angles from `first` on [right angles], at these radii in turn.
std::vector<Vec2> polygon(int corners, double first, const std::vector<double>& radii) {
  std::vector<Vec2> result;
  for (int i = 0; i < corners; ++i) {
    const double angle = 0.5 * std::numbers::pi * (first + 4.0 * i / corners);
    result.push_back(radii[static_cast<std::size_t>(i) % radii.size()] * Vec2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

}  // namespace

EventMark mark_of(EventKind kind) {
  constexpr bool filled = true;
  switch (kind) {
    case EventKind::start:
      return {.symbol = "circle", .outline = polygon(24, 0.0, {0.8}), .filled = !filled};
    case EventKind::end:
      return {.symbol = "square", .outline = polygon(4, 0.5, {1.1}), .filled = !filled};
    case EventKind::contact_closes:
      return {.symbol = "triangle-down", .outline = polygon(3, 3.0, {1.15}), .filled = filled};
    case EventKind::contact_opens:
      return {.symbol = "triangle-up", .outline = polygon(3, 1.0, {1.15}), .filled = !filled};
    case EventKind::contact_spreads:
      return {.symbol = "diamond-wide", .outline = polygon(4, 0.0, {1.3, 0.8}), .filled = filled};
    case EventKind::contact_splits:
      return {.symbol = "cross", .outline = polygon(8, 0.5, {1.3, 0.55}), .filled = filled};
    case EventKind::contact_shrinks:
      return {.symbol = "diamond-wide", .outline = polygon(4, 0.0, {1.3, 0.8}), .filled = !filled};
    case EventKind::contacts_merge:
      return {.symbol = "cross", .outline = polygon(8, 0.5, {1.3, 0.55}), .filled = !filled};
    case EventKind::contact_slips:
      return {.symbol = "triangle-right", .outline = polygon(3, 0.0, {1.15}), .filled = filled};
    case EventKind::contact_sticks:
      return {.symbol = "square", .outline = polygon(4, 0.5, {0.8}), .filled = filled};
    case EventKind::contact_transfers:
      return {.symbol = "diamond-tall", .outline = polygon(4, 0.0, {0.8, 1.3}), .filled = !filled};
    case EventKind::limit_point:
      return {.symbol = "circle", .outline = polygon(24, 0.0, {1.0}), .filled = filled};
    case EventKind::contact_limit_point:
      return {.symbol = "hexagon", .outline = polygon(6, 1.0, {1.1}), .size = 1.7, .filled = !filled};
    case EventKind::turning_point:
      return {.symbol = "square", .outline = polygon(4, 0.5, {1.1}), .filled = filled};
    case EventKind::value_crossing:
      return {.symbol = "diamond-tall", .outline = polygon(4, 0.0, {0.8, 1.3}), .filled = filled};
    case EventKind::reversal:
      return {.symbol = "triangle-left", .outline = polygon(3, 2.0, {1.15}), .filled = !filled};
    case EventKind::branch_point:
      return {.symbol = "star", .outline = polygon(10, 1.0, {1.4, 0.55}), .filled = filled};
    case EventKind::user:
      return {.symbol = "pentagon", .outline = polygon(5, 1.0, {1.1}), .filled = filled};
  }
  assert(false);
  return {};
}

std::string_view meaning(EventKind kind) {
  switch (kind) {
    case EventKind::start:
      return "the branch begins";
    case EventKind::end:
      return "the branch ends";
    case EventKind::contact_closes:
      return "a member comes into contact with a wall";
    case EventKind::contact_opens:
      return "a contact is released: its force becomes zero, or a zone separates";
    case EventKind::contact_spreads:
      return "a contact point becomes a contact zone";
    case EventKind::contact_splits:
      return "a contact becomes two, with a free span between";
    case EventKind::contact_shrinks:
      return "a contact zone becomes a contact point";
    case EventKind::contacts_merge:
      return "two contacts become one";
    case EventKind::contact_slips:
      return "a contact that stuck by friction begins to slip";
    case EventKind::contact_sticks:
      return "the slip of a contact ends: friction holds it";
    case EventKind::contact_transfers:
      return "contact moves between the end and the interior of a member, or over a joint";
    case EventKind::limit_point:
      return "λ has a maximum or minimum";
    case EventKind::contact_limit_point:
      return "λ reverses at a contact change or a kink";
    case EventKind::turning_point:
      return "a watched monitor has a maximum or minimum";
    case EventKind::value_crossing:
      return "a watched monitor passes a value";
    case EventKind::reversal:
      return "the load turns back, as the deck asks";
    case EventKind::branch_point:
      return "bifurcation: branches intersect";
    case EventKind::user:
      return "located by a detector that a program added";
  }
  assert(false);
  return {};
}

}  // namespace arcwall
