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
    case EventKind::contact_gathers:
      return {.symbol = "diamond-wide", .outline = polygon(4, 0.0, {1.3, 0.8}), .filled = !filled};
    case EventKind::contact_passes:
      return {.symbol = "diamond-tall", .outline = polygon(4, 0.0, {0.8, 1.3}), .filled = !filled};
    case EventKind::limit_point:
      return {.symbol = "circle", .outline = polygon(24, 0.0, {1.0}), .filled = filled};
    case EventKind::contact_limit_point:
      return {.symbol = "hexagon", .outline = polygon(6, 1.0, {1.1}), .size = 1.7, .filled = !filled};
    case EventKind::displacement_limit:
      return {.symbol = "square", .outline = polygon(4, 0.5, {1.1}), .filled = filled};
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
      return "the structure touches a wall";
    case EventKind::contact_opens:
      return "it lets go of a wall";
    case EventKind::contact_spreads:
      return "a touch at a point becomes a stretch";
    case EventKind::contact_gathers:
      return "a stretch becomes a touch at a point";
    case EventKind::contact_passes:
      return "a touch moves from a free end to the inside, or back";
    case EventKind::limit_point:
      return "the load turns: a dead load snaps here";
    case EventKind::contact_limit_point:
      return "the load turns at a change of contact";
    case EventKind::displacement_limit:
      return "a watched displacement turns";
    case EventKind::branch_point:
      return "other equilibria branch off";
    case EventKind::user:
      return "found by a detector of the program";
  }
  assert(false);
  return {};
}

}  // namespace arcwall
