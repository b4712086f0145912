#include "contact/sliding/lifting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/bounds/pressure.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/span_length.hpp"
#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

using Nodes = std::vector<std::size_t>;
using Span = SlidingContactLayout::Span;

// Pressed nodes where a part lifts off: of neighbours the one with the least pressure.
Nodes lifting_nodes(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  const auto& pressed = at.layout.pressed_nodes();
  Nodes nodes;
  std::size_t last_reached = 0;
  for (const PressureBound* bound : reached<PressureBound>(setting, at, tolerance)) {
    const std::size_t node = bound->node();
    const bool neighbour =
        !nodes.empty() && pressed[node].segment == pressed[nodes.back()].segment && node - last_reached == 1;
    last_reached = node;
    if (!neighbour) {
      nodes.push_back(node);
    } else if (least_pressure(setting, at, node).value < least_pressure(setting, at, nodes.back()).value) {
      nodes.back() = node;
    }
  }
  return nodes;
}

const SlidingContactLayout::Segment& part_of(const SlidingState& at, std::size_t node) {
  return at.layout.segments()[at.layout.pressed_nodes()[node].segment];
}

enum class Where { first_end, inside, last_end };

// Where a part lifts off. On a curved obstacle the pressure is known between nodes no better than by them.
Where lifts_off_at(const SlidingSetting& setting, const SlidingState& at, std::size_t node, double length) {
  const SlidingContactLayout::Segment& part = part_of(at, node);
  const double place = least_pressure(setting, at, node).s;
  const auto [begin, end] = at.layout.ends(setting.body, part, at.now.s);
  const double near = 0.5 * (lies_on_straight(setting, at, node) ? length : (end - begin) / part.elements);
  return place - begin < near ? Where::first_end : end - place < near ? Where::last_end : Where::inside;
}

// Splits the part of a pressed node by a free span where its pressure is least; tells the point behind which the span
// begins. Empty where the part is too short for that. Nodes are split from the last to the first.
std::optional<std::size_t> split(const SlidingSetting& setting, const SlidingState& at, std::size_t node, double length,
                                 LayoutEdit& edit) {
  const SlidingContactLayout::PressedNode& pressed = at.layout.pressed_nodes()[node];
  const SlidingContactLayout::Segment& part = at.layout.segments()[pressed.segment];
  if (part.first_point < 0 || part.last_point < 0) return std::nullopt;  // it reaches the end of its member
  const double place = least_pressure(setting, at, node).s;
  const double begin = at.s(part.first_point), end = at.s(part.last_point);
  const Where where = lifts_off_at(setting, at, node, length);
  const bool at_first = where == Where::first_end, at_last = where == Where::last_end;
  const double left = at_first ? begin : at_last ? end - length : place - 0.5 * length;
  const double next = edit.s[part.first_point + 1];  // up to where it has lifted before
  const double least = where == Where::inside ? 8.0 * shortest_span(setting.body, pressed.strand) : 0.0;
  if (left < begin || left + length > next || length < least) return std::nullopt;

  const auto elements = [&](double from, double to, int fewest) {  // with room to grow before the part is meshed anew
    return std::max(fewest, static_cast<int>(std::ceil(setting.body.elements_between(pressed.strand, from, to))));
  };
  const int fewest = fewest_pressed(lies_on_straight(setting, at, node));
  const int across = elements(left, left + length, 2), behind = elements(left + length, next, fewest);
  LayoutEdit::Entry edge{.point = {.obstacle = pressed.obstacle}, .strand = pressed.strand, .s = left, .closed = true};
  const std::size_t first = at_first ? static_cast<std::size_t>(part.first_point)
                                     : edit.insert(edge, elements(begin, left, fewest), at_last ? across : behind);
  edit.points[first].behind = Span::free;
  if (at_last) return first;
  edge.point.behind = Span::pressed;
  edge.s = left + length;
  edit.insert(edge, across, behind);
  return first;
}

// Parts with free spans of one length; empty where one of them is too short for its span.
std::optional<Transition> lifted(const SlidingSetting& setting, const SlidingState& at, const Nodes& nodes,
                                 double length) {
  LayoutEdit edit = edit_of(setting.body, at);
  std::size_t first = 0;  // the first of the new free spans begins behind this point
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const auto begins_behind = split(setting, at, *node, length, edit);
    if (!begins_behind) return std::nullopt;
    first = *begins_behind;
  }
  Transition transition = up_to(length, std::make_shared<SpanLength>(first), Transition::Change::splits,
                                mapped_onto(setting, at, edit, layout_of(edit)));
  for (std::size_t i = 0; i < at.layout.bounds().size(); ++i) {
    const auto* bound = dynamic_cast<const PressureBound*>(at.layout.bounds()[i].get());
    if (bound != nullptr && std::find(nodes.begin(), nodes.end(), bound->node()) != nodes.end())
      transition.contacts.push_back(static_cast<Index>(at.contacts() + i));
  }
  return transition;
}

}  // namespace

std::vector<Transition> parts_lift_off(const SlidingSetting& setting, const SlidingState& at, double tolerance) {
  const Nodes nodes = lifting_nodes(setting, at, tolerance);
  const SlidingContactLayout::Segment& part = part_of(at, nodes.front());
  const double shortest = shortest_span_on_straight(setting.body, part.strand);
  const bool at_ends_on_straight = std::all_of(nodes.begin(), nodes.end(), [&](std::size_t node) {
    return lies_on_straight(setting, at, node) && lifts_off_at(setting, at, node, shortest) != Where::inside;
  });
  std::vector<Transition> transitions;
  const auto try_length = [&](double length, double least) {
    auto transition = lifted(setting, at, nodes, length);
    if (!transition) return;
    transition->least = least;
    transitions.push_back(std::move(*transition));
  };
  if (at_ends_on_straight) {
    const std::size_t point = part.end_point();
    const double ahead = least_pressure(setting, at, nodes.front()).s - at.s(static_cast<Index>(point));
    const double sure = shortest_sure_arch(setting, at, point, ahead);
    for (const double factor : {2.0, 4.0, 8.0, 16.0, 1.0, 0.5})
      if (factor * sure > shortest) try_length(factor * sure, sure);
    try_length(2.0 * shortest, sure);
  } else {
    for (const double factor : {2.0, 4.0, 8.0, 16.0, 32.0})
      try_length(factor * shortest_span(setting.body, part.strand), 0.0);
  }
  transitions.push_back(unsupported(
      "a part that is pressed on a wall lifts off inside, and no equilibrium with one free stretch was found"));
  return transitions;
}

}  // namespace arcwall::sliding
